// SPDX-License-Identifier: MIT
// Plugins built with other flags, by another compiler or with a sanitizer work in one process. ORBIT_VARIANTS: from
// CMake, a comma-separated list.
#include <gtest/gtest.h>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/scene.hpp"

namespace muro {
namespace {

std::vector<std::string> variants() {
  std::vector<std::string> names(1);
  for (const char c : std::string(ORBIT_VARIANTS)) {
    if (c == ',')
      names.emplace_back();
    else
      names.back() += c;
  }
  return names;
}

class MixedBuilds : public testing::TestWithParam<std::string> {
 protected:
  /// Adds a robot with three red shapes, 2 m from the axis.
  const RobotView& add_robot(Simulation& simulation, const std::string& name) {
    const RobotTree tree = test::tree_of([](RobotBuilder& b) {
      b.base("base");
      Shape shapes[] = {Shape::box({1, 2, 3}), Shape::sphere(1), Shape::cylinder(1, 2)};
      for (Shape& s : shapes) s.color = {1, 0, 0.25, 0.5};
      b.set_array(keys::collision_shapes, std::span<const Shape>(shapes));
    });
    return simulation.world().add_robot(name, tree, {{2, 0, 1}, Quat::Identity()});
  }
  void use(Simulation& simulation, const RobotView& robot, const std::string& variant) {
    simulation.use("motion.orbit_" + variant, 100, {{&robot, robot.base()}},
                   {{"rate", 0.5}, {"who", std::string("world")}});
  }
  /// Compares the pose after 3 s at 0.5 rad/s with the closed form of the circle.
  void expect_orbit(Simulation& simulation, const RobotView& robot) {
    const Pose& pose = simulation.world().value(robot.base(), keys::pose);
    EXPECT_NEAR(pose.position.x(), 2 * std::cos(1.5), 1e-12);
    EXPECT_NEAR(pose.position.y(), 2 * std::sin(1.5), 1e-12);
    EXPECT_EQ(pose.position.z(), 1);
    EXPECT_NEAR(yaw_of(pose.orientation), 1.5, 1e-12);
    constexpr Key<double> paint{"abi.paint", "1", "sum of all colour values of the shapes"};
    EXPECT_EQ(simulation.world().value(robot.base(), paint), 3 * 1.75);
  }
};

TEST_P(MixedBuilds, LoadsAndFollowsTheSameOrbit) {
  Registry registry({ORBIT_DIR});
  Simulation simulation(registry);
  const RobotView& robot = add_robot(simulation, "rover");
  use(simulation, robot, GetParam());
  simulation.build();
  simulation.run_for(3);
  expect_orbit(simulation, robot);
}

TEST_P(MixedBuilds, SharesASceneWithEveryOtherOne) {
  Registry registry({ORBIT_DIR});
  Simulation simulation(registry);
  std::vector<const RobotView*> robots;
  for (const std::string& other : variants()) {
    robots.push_back(&add_robot(simulation, "rover_" + other));
    use(simulation, *robots.back(), other);
    robots.push_back(&add_robot(simulation, "partner_of_" + other));
    use(simulation, *robots.back(), GetParam());
  }
  simulation.build();
  const Snapshot start = simulation.snapshot();
  simulation.run_for(1);
  simulation.restore(start);
  simulation.run_for(3);
  for (const RobotView* r : robots) expect_orbit(simulation, *r);
}

INSTANTIATE_TEST_SUITE_P(Orbit, MixedBuilds, testing::ValuesIn(variants()),
                         [](const auto& test) { return test.param; });

}  // namespace
}  // namespace muro
