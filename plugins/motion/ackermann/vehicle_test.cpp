// SPDX-License-Identifier: MIT
// Tests of limits, joints, starts, hand-over and errors.
#include <gtest/gtest.h>

#include "ackermann_testing.hpp"
#include "core/instance.hpp"
#include "muro/toolkit/rotations.hpp"
#include "tests/support/complaint.hpp"

namespace muro {
namespace {

using namespace ackermann;

TEST(Ackermann, SteeringKeepsItsRateAndItsLimits) {
  std::vector<WheelSpec> wheels = bicycle(1);
  wheels[1].steering = {.lower = -0.3, .upper = 0.5, .velocity = 2};
  for (const double max_rate : {1e9, 0.5}) {
    Vehicle s(10, wheels, {{"max_steering_rate", max_rate}});
    const double rate = std::min(max_rate, 2.0);
    s.steer("front", 9);
    s.run_for(0.1);
    EXPECT_NEAR(s.angle("front"), 0.1 * rate, 1e-15);
    EXPECT_NEAR(s.value("front_steering", keys::joint_velocity), rate, 1e-15);
    s.run_for(2);
    EXPECT_EQ(s.angle("front"), 0.5);
    EXPECT_EQ(s.value("front_steering", keys::joint_velocity), 0);
    s.steer("front", -9);
    s.run_for(3);
    EXPECT_EQ(s.angle("front"), -0.3);
  }
}

TEST(Ackermann, DrivenWheelsKeepTheirLimits) {
  std::vector<WheelSpec> wheels = bicycle(1);
  wheels[0].wheel.velocity = 5;
  Vehicle s(100, wheels, {{"max_wheel_acceleration", 2.0}});
  s.drive("rear", 100);
  s.run_for(1);
  EXPECT_NEAR(s.turning("rear"), 2, 1e-12);
  EXPECT_NEAR(s.at().position.x(), 0.1, 1e-12);
  s.run_for(4);
  EXPECT_EQ(s.turning("rear"), 5);
}

TEST(Ackermann, DrivenWheelsThatDisagreeMoveItAtTheirMean) {
  Vehicle s(10, car(1, 0.6));
  s.drive("rear_left", 8), s.drive("rear_right", 10);
  s.run_for(1);
  EXPECT_NEAR(s.at().position.x(), 0.9, 1e-13) << "its straight front wheels keep it straight";
  EXPECT_NEAR(s.yaw(), 0, 1e-13);
  EXPECT_NEAR(s.turned("rear_left"), 8, 1e-13);
}

TEST(Ackermann, SteeringMayFollowAnotherJoint) {
  std::vector<WheelSpec> wheels = car(1, 0.6);
  wheels[3].leader = "front_left_steering_joint";
  Vehicle linked(10, wheels), free(10, car(1, 0.6));
  for (Vehicle* s : {&linked, &free}) s->steer("front_left", 0.3), s->drive("rear_left", 5), s->drive("rear_right", 5);
  free.steer("front_right", 0.3);
  linked.run_for(1), free.run_for(1);
  EXPECT_EQ(linked.angle("front_right"), 0.3);
  EXPECT_LT((linked.at().position - free.at().position).norm(), 1e-13);
  EXPECT_GT(linked.yaw(), 0.1);

  for (WheelSpec& p : wheels)
    if (p.steered) p.leader = "steering_wheel_joint", p.multiplier = 1.0 / 15;
  const auto column = [](RobotBuilder& b) {
    b.translation({0.5, 0, 0.5});
    b.revolute("steering_wheel_joint", Vec3::UnitX(), {.lower = -9, .upper = 9, .velocity = 3});
    b.body("steering_wheel");
  };
  Vehicle geared(10, vehicle_of(wheels, column));
  geared.value("steering_wheel", keys::joint_position_target) = 100;
  geared.run_for(2);
  EXPECT_NEAR(geared.angle("front_left"), 6 / 15.0, 1e-13);
  EXPECT_NEAR(geared.value("front_right_steering", keys::joint_velocity), 3 / 15.0, 1e-13);
}

TEST(Ackermann, OtherJointsFollowTheirTargets) {
  const auto lift = [](RobotBuilder& b) {
    b.prismatic("lift_joint", Vec3::UnitZ(), {.lower = 0, .upper = 0.5, .velocity = 2});
    b.body("lift");
  };
  Vehicle s(10, vehicle_of(bicycle(1), lift));
  s.value("lift", keys::joint_velocity_target) = 1;
  s.run_for(0.3);
  EXPECT_NEAR(s.value("lift", keys::joint_position), 0.3, 1e-15);
}

TEST(Ackermann, StartsAtTheSpeedAndAngleThatItIsGiven) {
  std::vector<WheelSpec> wheels = bicycle(2);
  RobotTree tree = vehicle_of(wheels);
  const Pose start{{1, 2, 0}, from_rpy(0, 0, 0.7)};
  const Vec3 forward = start.orientation * Vec3::UnitX(), left = start.orientation * Vec3::UnitY();
  Vehicle s(10, tree, {{"max_wheel_acceleration", 1.0}}, start, {0.5 * forward + 0.1 * left, Vec3::Zero()});
  EXPECT_NEAR(s.turning("rear"), 5, 1e-13);
  EXPECT_NEAR(s.turning("front"), 5, 1e-13);
  EXPECT_LT((s.moving().linear - 0.5 * forward).norm(), 1e-14) << "it cannot move sideways";
  s.run_for(1);
  EXPECT_NEAR(s.turning("rear"), 4, 1e-13) << "slows down to its target 0";
}

TEST(Ackermann, TakesOverAtTheSpeedOfTheBase) {
  Vehicle s(10, bicycle(2), {{"max_wheel_acceleration", 1.0}});
  s.run_for(0.1);
  s.angle("front") = 0.4;
  s.value("front_steering", keys::joint_velocity) = 3;
  const double turn = 1.5 * std::tan(0.4) / 2;
  s.moving() = {{1.5, 0, 0.3}, {0, 0.1, turn}};
  for (const auto& instance : s.instances()) {
    abi::ErrorText error;
    if (instance->setup().use == "motion.ackermann") {
      ASSERT_TRUE(instance->on_handover(0, error)) << error.view();
    }
  }
  EXPECT_NEAR(s.turning("rear"), 15, 1e-12);
  EXPECT_NEAR(s.turning("front"), 15 / std::cos(0.4), 1e-12);
  EXPECT_EQ(s.value("front_steering", keys::joint_velocity), 0);
  s.steer("front", 0.4);
  s.drive("rear", 15);
  s.run_for(0.1);
  EXPECT_NEAR(s.moving().angular.z(), turn, 1e-12);
}

TEST(Ackermann, GoesOnFromASnapshotToTheSameBits) {
  Vehicle s(100, car(0.3, 0.2, 0.02), {{"max_steering_rate", 0.3}, {"max_wheel_acceleration", 7.0}});
  s.steer("front_left", 0.4), s.steer("front_right", 0.3);
  s.drive("rear_left", 9), s.drive("rear_right", 12);
  s.run_for(0.537);
  const Snapshot snapshot = s.snapshot();
  s.run_for(1);
  const std::uint64_t end = s.state_hash();
  s.restore(snapshot);
  s.run_for(1);
  EXPECT_EQ(s.state_hash(), end);
}

TEST(Ackermann, VehiclesOfOneInstanceDoNotDisturbEachOther) {
  const auto run = [](int count) {
    test::Scene s;
    for (int i = 0; i < count; ++i)
      s.add("v" + std::to_string(i), vehicle_of(i % 2 == 0 ? car(0.3, 0.2, 0.02) : bicycle(1)));
    s.use("motion.ackermann", 100, s.all_robots(), {{"max_steering_rate", 0.2}});
    s.build();
    for (int i = 0; i < count; ++i) {
      const std::string name = "v" + std::to_string(i) + (i % 2 == 0 ? "/front_left" : "/front");
      s.world().value(name + "_steering_joint", keys::joint_position_target) = 0.3 + 0.01 * i;
      s.world().value("v" + std::to_string(i) + (i % 2 == 0 ? "/rear_left" : "/rear") + "_wheel_joint",
                      keys::joint_velocity_target) = 4 - i;
    }
    s.run_for(3);
    return s.world().hash(*s.world().find_robot("v0"));
  };
  EXPECT_EQ(run(1), run(7));
}

TEST(Ackermann, DrivesTheCarOfTheExamples) {
  test::Scene reader;
  Vehicle s(100, reader.read_model(MURO_TEST_SOURCE_DIR "/examples/models/car.urdf"));
  const double radius = 1, wheelbase = 0.33;
  for (const double side : {1.0, -1.0}) {
    const std::string end = side > 0 ? "left" : "right";
    s.value("front_" + end + "_steering", keys::joint_position_target) = std::atan(wheelbase / (radius - side * 0.098));
    s.value("rear_" + end + "_wheel", keys::joint_velocity_target) = 0.5 * (radius - side * 0.118) / 0.05;
  }
  s.run_for(1);
  EXPECT_NEAR(s.moving().linear.norm(), 0.5, 1e-12);
  EXPECT_NEAR(s.moving().angular.z(), 0.5, 1e-12);
}

std::string complaint(const RobotTree& tree, const Settings& settings = {}) {
  return test::complaint_of([&] { Vehicle s(10, tree, settings); });
}

TEST(Ackermann, AVehicleWithoutSteeredWheelsIsAnErrorThatTellsWhatItHas) {
  const std::string text = complaint(test::two_wheeler(0.05, 0.3));
  EXPECT_SAYS(
      text,
      "`car` has no steered wheels: `left_joint` is a wheel that is not steered; `right_joint` is a wheel that is "
      "not steered. Name the joints that steer with `steering`; a vehicle that turns by the speeds of its wheels "
      "is one for motion.differential_drive or motion.omni and their drives");
}

TEST(Ackermann, ASwivelWithoutLimitsIsACasterUnlessItIsNamed) {
  std::vector<WheelSpec> wheels = bicycle(1);
  wheels[1].steering = {};
  EXPECT_SAYS(complaint(vehicle_of(wheels)), "`front_wheel_joint` swivels about `front_steering_joint` as casters do");
  EXPECT_EQ(complaint(vehicle_of(wheels), {{"steering", Names{"front_steering_joint"}}}), "no complaint");
}

TEST(Ackermann, WrongNamesAreErrorsWithTheRightOnes) {
  const RobotTree tree = vehicle_of(bicycle(1));
  EXPECT_SAYS(
      complaint(tree, {{"steering", Names{"front"}}}),
      "`car` has no joint `front`; its joints are: `rear_wheel_joint` `front_steering_joint` `front_wheel_joint`");
  EXPECT_SAYS(
      complaint(tree, {{"steering", Names{"rear_wheel_joint"}}}),
      "joint `rear_wheel_joint` cannot steer: it turns about (0.000, 1.000, 0.000), not the z axis, of the base");
  EXPECT_SAYS(complaint(tree, {{"driven", Names{"front_steering_joint"}}}),
              "joint `front_steering_joint` cannot drive a wheel: it has limits of position");
  EXPECT_SAYS(complaint(tree, {{"driven", Names{"rear_wheel_joint", "rear_wheel_joint"}}}),
              "joint `rear_wheel_joint` is named twice; name a wheel once, in `driven` or in `rolling`");
  EXPECT_SAYS(complaint(tree, {{"rolling", Names{"rear_wheel_joint", "front_wheel_joint"}}}),
              "`car` has no driven wheels");
  EXPECT_SAYS(complaint(vehicle_of({bicycle(1)[1]})), "`car` has one wheel alone");
}

TEST(Ackermann, AStartOutsideOfTheLimitsIsAnError) {
  std::vector<WheelSpec> wheels = bicycle(1);
  wheels[1].steering = {.lower = 0.1, .upper = 0.5};
  EXPECT_SAYS(complaint(vehicle_of(wheels)), "joint `car/front_steering_joint` starts at 0, outside of its limits");
}

TEST(Ackermann, ATargetThatIsNotFiniteIsAnError) {
  for (const bool steering : {true, false}) {
    Vehicle s(100, bicycle(1), {{"max_steering_rate", 1.0}});
    s.steer("front", steering ? std::nan("") : 0.1);
    s.drive("rear", steering ? 1 : std::numeric_limits<double>::infinity());
    try {
      s.run_for(1);
      FAIL() << "went on with a target that is not finite";
    } catch (const StepError& e) {
      EXPECT_SAYS(std::string(e.what()), "a joint of `car` is to turn at a speed or to an angle that is not finite");
    }
  }
}

}  // namespace
}  // namespace muro
