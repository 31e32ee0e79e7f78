// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "tests/support/wheeled_robot.hpp"

namespace muro {
namespace {

using test::WheelPart;
using Settings = std::map<std::string, ParameterInput>;

/// A vehicle with a drive, which runs at 100 Hz, and, unless `motion` is empty, a motion model.
struct Driven : test::Scene {
  const RobotView& robot;
  Driven(const RobotTree& tree, const std::string& drive, Settings settings = {},
         const std::string& motion = "motion.differential_drive")
      : robot(add("rover", tree)) {
    if (!motion.empty()) use(motion, 100, all_robots());
    use(drive, 100, all_robots(), std::move(settings));
    build();
  }
  void command(double forward, double turn) {
    world().value(robot.base(), keys::command_twist) = {{forward, 0, 0}, {0, 0, turn}};
    run_for(0.01);
  }
  double target(const std::string& wheel) {
    return world().value("rover/" + wheel + "_joint", keys::joint_velocity_target);
  }
};

struct Draw {
  std::mt19937 engine;
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
};

std::vector<WheelPart> wheels_in_rows(int rows) {
  std::vector<WheelPart> wheels;
  for (int i = 0; i < rows; ++i)
    for (const double side : {1.0, -1.0})
      wheels.push_back(
          {.name = (side > 0 ? "left" : "right") + std::to_string(i), .at = {0.3 * i, 0.2 * side, 0}, .radius = 0.1});
  return wheels;
}

TEST(DifferentialDriveCommand, IsTheInverseOfTheReferenceRun) {
  Driven s(test::two_wheeler(0.05, 0.3), "drive.differential");
  s.command(0.45, 1.0 / 3);
  EXPECT_NEAR(s.target("left"), 8, 1e-13);
  EXPECT_NEAR(s.target("right"), 10, 1e-13);
}

TEST(DifferentialDriveCommand, MovesTheBaseAsCommandedWhateverTheWheelsAre) {
  Draw draw{std::mt19937(1)};
  for (int round = 0; round < 30; ++round) {
    const auto wheel = [&](const std::string& name, double side) {
      return WheelPart{.name = name,
                       .at = {0.3, side * draw(0.1, 0.5), 0},
                       .radius = draw(0.03, 0.3),
                       .axis = {0, draw(-1, 1) < 0 ? -1.0 : 1.0, 0}};
    };
    Driven s(test::wheeled_robot({wheel("a", 1), wheel("b", 1), wheel("c", -1)}), "drive.differential");
    const double forward = draw(-2, 2), turn = draw(-2, 2);
    s.command(forward, turn);
    const Twist& moving = s.twist(s.robot);
    const Vec3 in_base = s.pose(s.robot).orientation.conjugate() * moving.linear;
    EXPECT_NEAR(in_base.x(), forward, 1e-13);
    EXPECT_NEAR(in_base.y(), -0.3 * turn, 1e-13) << "the axle is 0.3 m in front of the base's origin";
    EXPECT_NEAR(moving.angular.z(), turn, 1e-13);
  }
}

TEST(DifferentialDriveCommand, KeepsTheCurvatureWhenAWheelIsAtItsLimit) {
  const JointLimits slow{.velocity = 12};
  const RobotTree tree = test::wheeled_robot(
      {{.name = "left", .at = {0, 0.15, 0}, .limits = slow}, {.name = "right", .at = {0, -0.15, 0}}});
  for (const double limit : {1e9, 5.0}) {
    Driven s(tree, "drive.differential", {{"max_wheel_speed", limit}});
    const double most = std::min(limit, 12.0);
    s.command(3, -4);
    EXPECT_NEAR(s.target("left"), most, 1e-12) << "wants (3 + 0.6) / 0.05";
    EXPECT_NEAR(s.target("right"), most * (3 - 0.6) / (3 + 0.6), 1e-12);
    const Twist& moving = s.twist(s.robot);
    EXPECT_NEAR(moving.angular.z() / moving.linear.norm(), -4.0 / 3, 1e-12);
    s.command(0.1, 0);
    EXPECT_NEAR(s.target("left"), 2, 1e-13) << "a slow command is left as it is";
  }
}

TEST(SkidSteer, DrivesFourAndSixWheels) {
  for (const int rows : {2, 3}) {
    Driven s(test::wheeled_robot(wheels_in_rows(rows)), "drive.skid_steer");
    s.command(1, 0.5);
    for (int i = 0; i < rows; ++i) {
      EXPECT_NEAR(s.target("left" + std::to_string(i)), 9, 1e-13);
      EXPECT_NEAR(s.target("right" + std::to_string(i)), 11, 1e-13);
    }
    EXPECT_NEAR(s.twist(s.robot).angular.z(), 0.5, 1e-13);
  }
}

TEST(SkidSteer, MakesUpForSlipWithAWiderTrack) {
  Driven s(test::wheeled_robot(wheels_in_rows(2)), "drive.skid_steer", {{"track_scale", 1.5}}, "");
  s.command(1, 0.5);
  EXPECT_NEAR(s.target("left0"), (1 - 0.5 * 1.5 * 0.2) / 0.1, 1e-13);
  EXPECT_NEAR(s.target("right1"), (1 + 0.5 * 1.5 * 0.2) / 0.1, 1e-13);
  s.command(1, 0);
  EXPECT_NEAR(s.target("left0"), 10, 1e-13) << "straight ahead nothing slips sideways";
}

TEST(SkidSteer, KeepsTheCurvatureOfAllWheels) {
  Driven s(test::wheeled_robot(wheels_in_rows(3)), "drive.skid_steer", {{"max_wheel_speed", 6.0}});
  s.command(-3, 1);
  EXPECT_NEAR(s.target("left0"), -6, 1e-12);
  for (int i = 0; i < 3; ++i) EXPECT_NEAR(s.target("right" + std::to_string(i)) / s.target("left0"), 2.8 / 3.2, 1e-13);
}

TEST(Drive, IsNoErrorOnALevelWithoutWheels) {
  Driven s(test::two_wheeler(0.05, 0.3), "drive.differential", {}, "motion.point");
  s.command(2, 0);
  s.run_for(0.99);
  EXPECT_NEAR(s.pose(s.robot).position.x(), 2, 1e-12);
}

TEST(Drive, RunsOnDemandJustBeforeTheMotion) {
  test::Scene s;
  const RobotView& robot = s.add("rover", test::two_wheeler(0.05, 0.3));
  s.use("motion.differential_drive", 10, s.all_robots());
  s.use("drive.differential", 0, s.all_robots());
  s.build();
  s.world().value(robot.base(), keys::command_twist).linear.x() = 1;
  s.run_for(1);
  EXPECT_NEAR(s.pose(robot).position.x(), 1, 1e-13);
}

TEST(Drive, AWheelThatMayNotTurnIsAnError) {
  const RobotTree tree = test::wheeled_robot(
      {{.name = "left", .at = {0, 0.15, 0}, .limits = {.velocity = 0}}, {.name = "right", .at = {0, -0.15, 0}}});
  try {
    Driven s(tree, "drive.differential");
    FAIL() << "a wheel without speed was taken";
  } catch (const SetupError& e) {
    EXPECT_NE(std::string(e.what()).find("the joint `rover/left_joint` has the velocity limit 0"), std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace muro
