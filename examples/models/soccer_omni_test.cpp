// SPDX-License-Identifier: MIT
// soccer_omni.urdf: its size, and its motion on its wheels as commanded.
#include <gtest/gtest.h>

#include "examples/models/stand_testing.hpp"
#include "muro/base/bounds.hpp"

namespace muro::models {
namespace {

TEST(SoccerOmni, KeepsToTheSizeOfItsLeague) {
  host::BuiltScenario b = built("soccer_omni.urdf", "");
  b.simulation->refresh();
  const World& world = b.simulation->world();
  double reach = 0, height = 0, low = 1;
  for (const Link& link : robot_of(b).links) {
    EXPECT_TRUE(
        is_possible(world.constant(link.object, keys::inertial, Inertia{.mass = 1, .ixx = 1, .iyy = 1, .izz = 1})));
    for (const Shape& s : world.constants(link.object, keys::collision_shapes)) {
      const Aabb box = bounds_of(s, world.value(link.object, keys::pose) * s.origin);
      height = std::max(height, box.high.z());
      low = std::min(low, box.low.z());
      reach = std::max({reach, box.high.x(), -box.low.x(), box.high.y(), -box.low.y()});
    }
  }
  EXPECT_LE(reach, 0.09) << "the rules of the Small Size League: 0.18 m across";
  EXPECT_LE(height, 0.15) << "and 0.15 m high";
  EXPECT_NEAR(low, 0, 1e-9) << "it stands on its wheels";
  EXPECT_NEAR(mass_of(b), 2.6, 1e-12);
}

TEST(SoccerOmni, DrivesWhereItIsTold) {
  const Vec3 velocities[] = {{0.5, 0, 0}, {0, 0.5, 0}, {0.3, -0.3, 0}};
  for (const Vec3& v : velocities) {
    host::BuiltScenario b = built("soccer_omni.urdf", "motion: {use: motion.omni}, drive: {use: drive.omni}");
    Simulation& s = *b.simulation;
    Twist& command = s.world().value(s.world().object("r/base_link"), keys::command_twist);
    command.linear = v;
    s.run_for(0.5);
    const Pose early = s.world().value(robot_of(b).base(), keys::pose);
    s.run_for(1);
    const Pose& late = s.world().value(robot_of(b).base(), keys::pose);
    EXPECT_LT((late.position - early.position - v).norm(), 1e-3) << v.transpose();
    EXPECT_NEAR(late.orientation.z(), 0, 1e-6);
  }
}

}  // namespace
}  // namespace muro::models
