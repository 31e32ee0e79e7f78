// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "plugins/common/wheels/side_wheel_drive_testing.hpp"

namespace muro {
namespace {

using test::WheelPart;
using Settings = std::map<std::string, ParameterInput>;

struct Driven : test::SideWheelVehicle {
  explicit Driven(const RobotTree& tree, Settings settings = {},
                  const std::string& motion = "motion.differential_drive")
      : SideWheelVehicle(tree, "drive.differential", std::move(settings), motion) {}
};

struct Draw {
  std::mt19937 engine;
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
};

TEST(DifferentialDrive, IsTheInverseOfTheReferenceRun) {
  Driven s(test::two_wheeler(0.05, 0.3));
  s.command(0.45, 1.0 / 3);
  EXPECT_NEAR(s.target("left"), 8, 1e-13);
  EXPECT_NEAR(s.target("right"), 10, 1e-13);
}

TEST(DifferentialDrive, MovesTheBaseAsCommandedWhateverTheWheelsAre) {
  Draw draw{std::mt19937(1)};
  for (int round = 0; round < 30; ++round) {
    const auto wheel = [&](const std::string& name, double side) {
      return WheelPart{.name = name,
                       .at = {0.3, side * draw(0.1, 0.5), 0},
                       .radius = draw(0.03, 0.3),
                       .axis = {0, draw(-1, 1) < 0 ? -1.0 : 1.0, 0}};
    };
    Driven s(test::wheeled_robot({wheel("a", 1), wheel("b", 1), wheel("c", -1)}));
    const double forward = draw(-2, 2), turn = draw(-2, 2);
    s.command(forward, turn);
    const Twist& moving = s.twist(s.robot);
    const Vec3 in_base = s.pose(s.robot).orientation.conjugate() * moving.linear;
    EXPECT_NEAR(in_base.x(), forward, 1e-13);
    EXPECT_NEAR(in_base.y(), -0.3 * turn, 1e-13) << "the axle is 0.3 m in front of the base's origin";
    EXPECT_NEAR(moving.angular.z(), turn, 1e-13);
  }
}

TEST(DifferentialDrive, KeepsTheCurvatureWhenAWheelIsAtItsLimit) {
  const JointLimits slow{.velocity = 12};
  const RobotTree tree = test::wheeled_robot(
      {{.name = "left", .at = {0, 0.15, 0}, .limits = slow}, {.name = "right", .at = {0, -0.15, 0}}});
  for (const double limit : {1e9, 5.0}) {
    Driven s(tree, {{"max_wheel_speed", limit}});
    const double max_speed = std::min(limit, 12.0);
    s.command(3, -4);
    EXPECT_NEAR(s.target("left"), max_speed, 1e-12) << "wants (3 + 0.6) / 0.05";
    EXPECT_NEAR(s.target("right"), max_speed * (3 - 0.6) / (3 + 0.6), 1e-12);
    const Twist& moving = s.twist(s.robot);
    EXPECT_NEAR(moving.angular.z() / moving.linear.norm(), -4.0 / 3, 1e-12);
    s.command(0.1, 0);
    EXPECT_NEAR(s.target("left"), 2, 1e-13) << "a slow command is left as it is";
  }
}

TEST(DifferentialDrive, IsNoErrorOnALevelWithoutWheels) {
  Driven s(test::two_wheeler(0.05, 0.3), {}, "motion.point");
  s.command(2, 0);
  s.run_for(0.99);
  EXPECT_NEAR(s.pose(s.robot).position.x(), 2, 1e-12);
}

TEST(DifferentialDrive, RunsOnDemandJustBeforeTheMotion) {
  test::Scene s;
  const RobotView& robot = s.add("rover", test::two_wheeler(0.05, 0.3));
  s.use("motion.differential_drive", 10, s.all_robots());
  s.use("drive.differential", 0, s.all_robots());
  s.build();
  s.world().value(robot.base(), keys::command_twist).linear.x() = 1;
  s.run_for(1);
  EXPECT_NEAR(s.pose(robot).position.x(), 1, 1e-13);
}

TEST(DifferentialDrive, AWheelThatMayNotTurnIsAnError) {
  const RobotTree tree = test::wheeled_robot(
      {{.name = "left", .at = {0, 0.15, 0}, .limits = {.velocity = 0}}, {.name = "right", .at = {0, -0.15, 0}}});
  try {
    Driven s(tree);
    FAIL() << "a wheel without speed was taken";
  } catch (const SetupError& e) {
    EXPECT_NE(std::string(e.what()).find("the joint `rover/left_joint` has the velocity limit 0"), std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace muro
