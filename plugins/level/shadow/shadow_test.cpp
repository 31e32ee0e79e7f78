// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include "tests/support/bodies.hpp"

namespace muro {
namespace {

const Inertia light{.mass = 1, .ixx = 0.004, .iyy = 0.004, .izz = 0.004};

RobotTree cube() { return test::single_body(Shape::box({0.2, 0.2, 0.2}), light); }

/// A robot that motion.point moves and its shadow, which forces move. A wall or another robot may be in the way.
struct Shaded : test::Scene {
  const RobotView *robot, *shadow;
  Shaded() {
    world().set(world_object, keys::gravity, Vec3(0, 0, 0));
    robot = &add("r", cube(), {{0, 0, 0}, Quat::Identity()}, {{1, 0, 0}, Vec3::Zero()});
    shadow = &add("r.shadow", cube(), {{0, 0, 0}, Quat::Identity()}, {{1, 0, 0}, Vec3::Zero()});
    world().set(shadow->base(), keys::shadow_of, robot->base());
    use("motion.point", 1000, {{robot, robot->base()}});
    use("motion.simplified", 1000, {{shadow, shadow->base()}});
    use("level.shadow", 100, {{shadow, shadow->base()}});
  }
  void start() {
    use_contacts();
    build();
    world().value(robot->base(), keys::command_twist) = {{1, 0, 0}, Vec3::Zero()};
  }
  double value(const char* key) {
    return *static_cast<const double*>(world().store().find(shadow->base(), key)->place);
  }
};

TEST(Shadow, StaysWithItsRobotWhereBothMoveAlike) {
  Shaded s;
  s.start();
  s.run_for(1);
  EXPECT_NEAR(s.pose(*s.robot).position.x(), 1, 1e-9);
  EXPECT_LT(s.value("shadow.distance.max"), 1e-9);
}

TEST(Shadow, FeelsAWallThatItsRobotGoesThrough) {
  Shaded s;
  const Shape wall = Shape::box({0.2, 4, 4});
  s.world().add_scenery("wall", {{0.7, 0, 0}, Quat::Identity()}, std::span<const Shape>(&wall, 1));
  s.start();
  s.run_for(1);
  EXPECT_NEAR(s.pose(*s.robot).position.x(), 1, 1e-9);
  EXPECT_LT(s.pose(*s.shadow).position.x(), 0.51);
  s.run_for(0.001);
  EXPECT_NEAR(s.value("shadow.distance"), (s.pose(*s.robot).position - s.pose(*s.shadow).position).norm(), 2e-3);
  EXPECT_GE(s.value("shadow.distance.max"), s.value("shadow.distance"));
}

TEST(Shadow, IsFeltByNobody) {
  const auto run = [](bool with_shadow) {
    test::Scene s;
    s.world().set(world_object, keys::gravity, Vec3(0, 0, 0));
    const RobotView& other = s.add("other", cube(), {{1, 0, 0}, Quat::Identity()});
    const RobotView& robot = s.add("r", cube(), {{0, 5, 0}, Quat::Identity()});
    s.use("motion.simplified", 1000, {{&other, other.base()}});
    s.use("motion.point", 1000, {{&robot, robot.base()}});
    const RobotView* shadow = nullptr;
    if (with_shadow) {
      shadow = &s.add("r.shadow", cube(), {{0, 0, 0}, Quat::Identity()}, {{1, 0, 0}, Vec3::Zero()});
      s.world().set(shadow->base(), keys::shadow_of, robot.base());
      s.use("motion.simplified", 1000, {{shadow, shadow->base()}});
    }
    s.use_contacts();
    s.build();
    s.run_for(2);
    if (shadow) {
      EXPECT_NEAR(s.twist(*shadow).linear.x(), 0, 1e-3)
          << "it is in contact with the other robot, which is a wall to it";
    }
    return s.world().hash(other);
  };
  EXPECT_EQ(run(true), run(false));
}

TEST(Shadow, IsSeenByNoLaser) {
  test::Scene s;
  const RobotView& robot = s.add("r", cube(), {{0, 0, 0}, Quat::Identity()});
  const RobotView& shadow = s.add("r.shadow", cube(), {{2, 0, 0}, Quat::Identity()});
  s.world().set(shadow.base(), keys::shadow_of, robot.base());
  s.use("motion.point", 100, s.all_robots());
  const ObjectId laser = s.add_sensor_object(robot, "laser", robot.base());
  s.use("laser.raycast", 10, {{&robot, laser}},
        {{"rays", std::int64_t(1)}, {"min_angle", 0.0}, {"max_angle", 0.0}, {"max_range", 5.0}});
  s.use_contacts();
  s.build();
  s.run_for(0.2);
  EXPECT_EQ(s.world().values(laser, keys::ranges)[0], 5.0);
}

}  // namespace
}  // namespace muro
