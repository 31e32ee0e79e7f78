// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "core/instance.hpp"
#include "muro/toolkit/rotations.hpp"
#include "tests/support/wheeled_robot.hpp"

namespace muro {
namespace {

using test::WheelPart;
using Settings = std::map<std::string, ParameterInput>;

/// The reference vehicle: wheels of 0.05 m, 0.3 m apart.
struct Vehicle : test::Scene {
  const RobotView& robot;
  Vehicle(double rate, const RobotTree& tree, Settings settings = {}, const Pose& start = {}, const Twist& moving = {})
      : robot(add("rover", tree, start, moving)) {
    use("motion.differential_drive", rate, all_robots(), std::move(settings));
    use("kinematics.direct", 2 * rate, all_robots());  // every other run sees the end of a step
    build();
  }
  explicit Vehicle(double rate, Settings settings = {}, const Pose& start = {})
      : Vehicle(rate, test::two_wheeler(0.05, 0.3), std::move(settings), start) {}

  double& value(const std::string& joint, const Key<double>& key) {
    return world().value("rover/" + joint + "_joint", key);
  }
  void turn_wheels(double left, double right) {
    value("left", keys::joint_velocity_target) = left;
    value("right", keys::joint_velocity_target) = right;
  }
  Pose& at() { return pose(robot); }
  Twist& moving() { return twist(robot); }
  double yaw() { return yaw_of(at().orientation); }
};

struct Draw {
  std::mt19937 engine;
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
  Vec3 vector(double limit) { return {(*this)(-limit, limit), (*this)(-limit, limit), (*this)(-limit, limit)}; }
};

TEST(DifferentialDrive, FollowsAnExactArcForAnyStepSize) {
  for (const double rate : {0.1, 1.0, 3.0, 10.0, 100.0, 1000.0}) {
    Vehicle s(rate);
    s.turn_wheels(8, 10);
    s.run_for(10);
    EXPECT_NEAR(s.at().position.x(), -0.2572667, 1e-7) << rate << " Hz";
    EXPECT_NEAR(s.at().position.y(), 2.6752599, 1e-7) << rate << " Hz";
    EXPECT_NEAR(std::remainder(s.yaw() - 10.0 / 3, 2 * M_PI), 0, 1e-11) << rate << " Hz";
    EXPECT_NEAR(s.at().position.x(), 1.35 * std::sin(10.0 / 3), 1e-11) << rate << " Hz";
    EXPECT_NEAR(s.at().position.y(), 1.35 * (1 - std::cos(10.0 / 3)), 1e-11) << rate << " Hz";
    EXPECT_NEAR(s.value("left", keys::joint_position), 80, 1e-9);
    EXPECT_NEAR(s.value("right", keys::joint_position), 100, 1e-9);
    EXPECT_NEAR(s.moving().linear.norm(), 0.45, 1e-14);
    EXPECT_NEAR(s.moving().angular.z(), 1.0 / 3, 1e-14);
  }
}

/// Returns the end of the reference run with wheels that speed up by `a` rad/s^2, by Simpson's rule.
Vec3 gradual_start(double a, double duration) {
  const int n = 100000;
  const auto angle = [&](double t, double last) {
    const double ramp = last / a;
    return t < ramp ? 0.5 * a * t * t : 0.5 * a * ramp * ramp + last * (t - ramp);
  };
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i <= n; ++i) {
    const double t = duration * i / n;
    const double left = std::min(8.0, a * t), right = std::min(10.0, a * t);
    const double heading = 0.05 / 0.3 * (angle(t, 10) - angle(t, 8));
    const double weight = i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2;
    sum += weight * 0.5 * 0.05 * (left + right) * Vec3(std::cos(heading), std::sin(heading), 0);
  }
  return sum * duration / (3 * n);
}

TEST(DifferentialDrive, AGradualStartIsExactForAnyStepSize) {
  const Vec3 expected = gradual_start(2, 10);
  for (const double rate : {1.3, 7.0, 100.0}) {
    Vehicle s(rate, {{"max_wheel_acceleration", 2.0}});
    s.turn_wheels(8, 10);
    s.run_for(10);
    EXPECT_LT((s.at().position - expected).norm(), 1e-9) << rate << " Hz";
    EXPECT_NEAR(s.value("left", keys::joint_position), 0.5 * 2 * 16 + 8 * 6, 1e-9);
    EXPECT_NEAR(s.value("right", keys::joint_position), 0.5 * 2 * 25 + 10 * 5, 1e-9);
    EXPECT_NEAR(s.yaw(), 0.05 / 0.3 * (75 - 64), 1e-11);
  }
}

TEST(DifferentialDrive, StaysInThePlaneThroughItsInitialPose) {
  Draw draw{std::mt19937(1)};
  for (int round = 0; round < 10; ++round) {
    const Pose start{draw.vector(5), rotation_of(draw.vector(2))};
    Vehicle s(200, {}, start);
    s.turn_wheels(8, 10);
    s.run_for(10);
    const Pose in_plane = start.inverse() * s.at();
    EXPECT_NEAR(in_plane.position.z(), 0, 1e-12);
    EXPECT_NEAR(in_plane.position.x(), 1.35 * std::sin(10.0 / 3), 1e-11);
    EXPECT_NEAR(in_plane.position.y(), 1.35 * (1 - std::cos(10.0 / 3)), 1e-11);
    EXPECT_NEAR((in_plane.orientation * Vec3::UnitZ()).z(), 1, 1e-14);
    const Vec3 forward = s.at().orientation * Vec3::UnitX(), up = start.orientation * Vec3::UnitZ();
    EXPECT_LT((s.moving().linear - 0.45 * forward).norm(), 1e-12);
    EXPECT_LT((s.moving().angular - up / 3).norm(), 1e-12);
  }
}

TEST(DifferentialDrive, EqualWheelsDriveStraightAndOppositeOnesTurnOnTheSpot) {
  Vehicle s(100);
  s.turn_wheels(6, 6);
  s.run_for(10);
  EXPECT_NEAR(s.at().position.x(), 3, 1e-12);
  EXPECT_EQ(s.at().position.y(), 0);
  EXPECT_EQ(s.yaw(), 0);
  s.turn_wheels(-6, 6);
  s.run_for(1);
  EXPECT_LT((s.at().position - Vec3(3, 0, 0)).norm(), 1e-12);
  EXPECT_NEAR(s.yaw(), 2, 1e-12);
}

TEST(DifferentialDrive, NearlyStraightIsNearlyStraight) {
  for (const double difference : {1e-3, 1e-6, 1e-9, 1e-12}) {
    Vehicle s(1);
    s.turn_wheels(8, 8 + difference);
    s.run_for(10);
    const double turn = 0.05 * difference / 0.3, v = 0.05 * (8 + 0.5 * difference);
    EXPECT_NEAR(s.at().position.x(), 10 * v, 1e3 * turn * turn + 1e-13);
    EXPECT_NEAR(s.at().position.y(), 50 * v * turn, 1e3 * turn * turn * turn + 1e-13);
  }
}

TEST(DifferentialDrive, WheelsOfAnyMakeAndPlaceRollWithoutSlip) {
  Draw draw{std::mt19937(2)};
  for (int round = 0; round < 20; ++round) {
    const double axle = draw(-0.5, 0.5), radius[] = {draw(0.03, 0.2), draw(0.03, 0.2)};
    const auto axis = [&] { return Vec3(0, draw(-1, 1) < 0 ? -2 : 1, 0); };
    const RobotTree tree = test::wheeled_robot(
        {{.name = "left", .at = {axle, draw(0.1, 0.4), radius[0]}, .radius = radius[0], .axis = axis()},
         {.name = "right", .at = {axle, draw(-0.4, -0.1), radius[1]}, .radius = radius[1], .axis = axis()}});
    Vehicle s(50, tree, {{"max_wheel_acceleration", draw(5, 100)}}, {draw.vector(2), rotation_of(draw.vector(2))});
    s.turn_wheels(draw(-9, 9), draw(-9, 9));
    s.run_for(0.415);
    EXPECT_GT(s.moving().angular.norm() + s.moving().linear.norm(), 1e-3);
    for (const int i : {0, 1}) {
      const Twist wheel = s.world().value(i == 0 ? "rover/left_wheel" : "rover/right_wheel", keys::twist);
      const Vec3 lowest = s.at().orientation * Vec3(0, 0, -radius[i]);
      EXPECT_LT(wheel.at(lowest).norm(), 1e-13) << "round " << round;
    }
  }
}

TEST(DifferentialDrive, TheBaseMovesWithTheMeanOfASide) {
  const RobotTree tree = test::wheeled_robot({{.name = "left", .at = {0.2, 0.15, 0}},
                                              {.name = "left_rear", .at = {-0.2, 0.15, 0}},
                                              {.name = "right", .at = {0.2, -0.15, 0}},
                                              {.name = "right_rear", .at = {-0.2, -0.15, 0}}});
  Vehicle s(10, tree);
  s.turn_wheels(8, 10);
  s.value("left_rear", keys::joint_velocity_target) = 4;
  s.value("right_rear", keys::joint_velocity_target) = -2;
  s.run_for(2);
  // left 6, right 4: v = 0.25 m/s, w = -1/3 rad/s
  EXPECT_NEAR(s.at().position.x(), -0.75 * std::sin(-2.0 / 3), 1e-13);
  EXPECT_NEAR(s.at().position.y(), -0.75 * (1 - std::cos(-2.0 / 3)), 1e-13);
  EXPECT_NEAR(s.value("left", keys::joint_position), 16, 1e-13);
  EXPECT_NEAR(s.value("left_rear", keys::joint_position), 8, 1e-13);
  EXPECT_NEAR(s.value("right_rear", keys::joint_position), -4, 1e-13);
  EXPECT_EQ(s.value("right_rear", keys::joint_velocity), -2);
}

TEST(DifferentialDrive, ABaseBehindItsAxleSwingsAboutTheAxle) {
  const RobotTree tree =
      test::wheeled_robot({{.name = "left", .at = {0.4, 0.25, 0}}, {.name = "right", .at = {0.4, -0.15, 0}}});
  Vehicle s(10, tree);
  s.turn_wheels(-4, 4);  // 1 rad/s about the middle of the axle, (0.4, 0.05)
  s.run_for(1.5);
  const Vec3 middle(0.4, 0.05, 0);
  const Vec3 expected = middle - Eigen::AngleAxisd(1.5, Vec3::UnitZ()) * middle;
  EXPECT_LT((s.at().position - expected).norm(), 1e-13);
  EXPECT_NEAR(s.yaw(), 1.5, 1e-13);
}

TEST(DifferentialDrive, KeepsTheLimitsOfItsWheels) {
  const JointLimits limits{.velocity = 5};
  const RobotTree tree = test::wheeled_robot({{.name = "left", .at = {0, 0.15, 0}, .limits = limits},
                                              {.name = "right", .at = {0, -0.15, 0}, .limits = limits}});
  Vehicle s(100, tree, {{"max_wheel_acceleration", 2.0}});
  s.turn_wheels(100, -100);
  s.run_for(1);
  EXPECT_NEAR(s.value("left", keys::joint_velocity), 2, 1e-12);
  s.run_for(4);
  EXPECT_EQ(s.value("left", keys::joint_velocity), 5);
  EXPECT_EQ(s.value("right", keys::joint_velocity), -5);
}

TEST(DifferentialDrive, OtherJointsFollowTheirTargetsWithinTheirLimits) {
  const RobotTree tree = test::wheeled_robot(
      {{.name = "left", .at = {0, 0.15, 0}}, {.name = "right", .at = {0, -0.15, 0}}}, [](RobotBuilder& b) {
        b.fork();
        b.prismatic("lift_joint", Vec3::UnitZ(), {.lower = 0, .upper = 0.5, .velocity = 2});
        b.set(keys::initial_joint_position, 0.1);
        b.body("lift");
        b.end();
        b.revolute("pan_joint", Vec3::UnitZ(), {});
        b.mimic("lift_joint", 3, 1);
        b.body("pan");
        b.end();
      });
  Vehicle s(10, tree);
  EXPECT_DOUBLE_EQ(s.value("pan", keys::joint_position), 1.3) << "follows from the start";
  s.value("lift", keys::joint_velocity_target) = 1;
  s.run_for(0.3);
  EXPECT_NEAR(s.value("lift", keys::joint_position), 0.4, 1e-15);
  EXPECT_EQ(s.value("lift", keys::joint_velocity), 1);
  EXPECT_NEAR(s.value("pan", keys::joint_position), 2.2, 1e-15);
  EXPECT_EQ(s.value("pan", keys::joint_velocity), 3);
  s.run_for(0.3);
  EXPECT_EQ(s.value("lift", keys::joint_position), 0.5);
  EXPECT_EQ(s.value("lift", keys::joint_velocity), 0);
  s.value("lift", keys::joint_velocity_target) = -9;
  s.run_for(0.1);
  EXPECT_NEAR(s.value("lift", keys::joint_position), 0.3, 1e-15) << "at most 2 m/s";
  EXPECT_EQ(s.at().position, Vec3::Zero());
}

TEST(DifferentialDrive, StartsAtTheSpeedThatItIsGiven) {
  const Pose start{{1, 2, 0}, from_rpy(0, 0, 0.7)};
  const Vec3 forward = start.orientation * Vec3::UnitX();
  Vehicle s(10, test::two_wheeler(0.05, 0.3), {{"max_wheel_acceleration", 1.0}}, start,
            {0.45 * forward, {0, 0, 1.0 / 3}});
  EXPECT_NEAR(s.value("left", keys::joint_velocity), 8, 1e-13);
  EXPECT_NEAR(s.value("right", keys::joint_velocity), 10, 1e-13);
  EXPECT_LT((s.moving().linear - 0.45 * forward).norm(), 1e-15);
  s.run_for(1);
  EXPECT_NEAR(s.value("left", keys::joint_velocity), 7, 1e-13) << "slows down to its target 0";
}

TEST(DifferentialDrive, TakesOverAtTheSpeedOfTheBase) {
  Vehicle s(10, {{"max_wheel_acceleration", 1.0}});
  s.run_for(0.1);
  s.at().orientation = from_rpy(0.1, 0.2, 0.7);
  const Vec3 forward = s.at().orientation * Vec3::UnitX(), left = s.at().orientation * Vec3::UnitY();
  const Vec3 up = s.at().orientation * Vec3::UnitZ();
  s.moving() = {0.45 * forward + 0.2 * left, up / 3 + 0.1 * left};
  for (const auto& instance : s.instances()) {
    abi::ErrorText error;
    if (instance->setup().use == "motion.differential_drive") {
      ASSERT_TRUE(instance->on_handover(0, error)) << error.view();
    }
  }
  EXPECT_NEAR(s.value("left", keys::joint_velocity), 8, 1e-12);
  EXPECT_NEAR(s.value("right", keys::joint_velocity), 10, 1e-12);
  s.turn_wheels(8, 10);
  s.run_for(0.1);
  EXPECT_NEAR(s.moving().linear.norm(), 0.45, 1e-12) << "what wheels cannot do is dropped";
  EXPECT_NEAR(s.moving().angular.norm(), 1.0 / 3, 1e-12);
}

TEST(DifferentialDrive, TakesWheelsRadiusAndTrackFromTheUser) {
  const RobotTree tree = test::wheeled_robot({{.name = "left", .at = {0, 0.15, 0}},
                                              {.name = "right", .at = {0, -0.15, 0}},
                                              {.name = "idle_left", .at = {-1, 0.15, 0}},
                                              {.name = "idle_right", .at = {-1, -0.15, 0}}});
  Vehicle s(10, tree,
            {{"left", std::vector<std::string>{"left_joint"}},
             {"right", std::vector<std::string>{"right_joint"}},
             {"wheel_radius", 0.1},
             {"track", 0.6}});
  s.turn_wheels(8, 10);
  s.run_for(1);
  EXPECT_NEAR(s.yaw(), 1.0 / 3, 1e-13);
  EXPECT_NEAR(s.moving().linear.norm(), 0.9, 1e-13);
  EXPECT_NEAR(s.at().position.x(), 2.7 * std::sin(1.0 / 3), 1e-13);
}

TEST(DifferentialDrive, VehiclesOfOneInstanceDoNotDisturbEachOther) {
  const auto run = [](int count) {
    test::Scene s;
    for (int i = 0; i < count; ++i)
      s.add("v" + std::to_string(i), i % 2 == 0 ? test::two_wheeler(0.05, 0.3) : test::two_wheeler(0.08, 0.5));
    s.use("motion.differential_drive", 100, s.all_robots());
    s.build();
    for (int i = 0; i < count; ++i) {
      s.world().value("v" + std::to_string(i) + "/left_joint", keys::joint_velocity_target) = 3 + i;
      s.world().value("v" + std::to_string(i) + "/right_joint", keys::joint_velocity_target) = 4 - i;
    }
    s.run_for(3);
    return s.world().hash(*s.world().find_robot("v0"));
  };
  EXPECT_EQ(run(1), run(7));
}

TEST(DifferentialDrive, AWheelThatIsToTurnAtNoFiniteSpeedIsAnError) {
  Vehicle s(100);
  s.turn_wheels(std::nan(""), 1);
  try {
    s.run_for(1);
    FAIL() << "went on with a target of nan";
  } catch (const StepError& e) {
    EXPECT_NE(std::string(e.what()).find("a wheel of `rover` is to turn at a speed that is not finite"),
              std::string::npos)
        << e.what();
  }
}

}  // namespace
}  // namespace muro
