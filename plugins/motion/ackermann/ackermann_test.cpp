// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "core/instance.hpp"
#include "tests/support/wheeled_robot.hpp"

namespace muro {
namespace {

using Settings = std::map<std::string, ParameterInput>;
using Names = std::vector<std::string>;
constexpr double wide = 1.4;

/// A wheel of a test's vehicle: "NAME_wheel_joint", and "NAME_steering_joint" when it is steered.
struct Part {
  std::string name;
  Vec3 at;  ///< m, of the steering joint, or of the wheel
  bool steered = false;
  double radius = 0.1;
  Vec3 arm = Vec3::Zero();  ///< m, from the steering joint to the wheel
  Vec3 axis = Vec3::UnitY();
  Vec3 upright = Vec3::UnitZ();
  JointLimits steering{.lower = -wide, .upper = wide};
  JointLimits wheel{};
  std::string leader{};  ///< of the steering joint
  double multiplier = 1;
};

RobotTree vehicle_of(
    const std::vector<Part>& parts, const std::function<void(RobotBuilder&)>& more = [](RobotBuilder&) {}) {
  return test::tree_of([&](RobotBuilder& b) {
    b.base("chassis");
    for (const Part& p : parts) {
      const Shape tyre = test::tyre(p.radius);
      b.fork();
      b.translation(p.at);
      if (p.steered) {
        b.revolute(p.name + "_steering_joint", p.upright, p.steering);
        if (!p.leader.empty()) b.mimic(p.leader, p.multiplier, 0);
        b.body(p.name + "_knuckle");
        b.translation(p.arm);
      }
      b.revolute(p.name + "_wheel_joint", p.axis, p.wheel);
      b.body(p.name + "_wheel");
      b.set_array(keys::collision_shapes, std::span<const Shape>(&tyre, 1));
      b.end();
    }
    more(b);
    for (std::size_t i = 0; i < parts.size(); ++i) b.end();
  });
}

std::vector<Part> bicycle(double wheelbase) {
  return {{.name = "rear", .at = {0, 0, 0}}, {.name = "front", .at = {wheelbase, 0, 0}, .steered = true}};
}
/// Rear wheels driven, front wheels steered about joints `scrub` inside of them.
std::vector<Part> car(double wheelbase, double track, double scrub = 0) {
  std::vector<Part> parts;
  for (const double side : {0.5, -0.5}) {
    const std::string end = side > 0 ? "_left" : "_right";
    parts.push_back({.name = "rear" + end, .at = {0, side * track, 0}});
    parts.push_back({.name = "front" + end,
                     .at = {wheelbase, side * (track - 2 * scrub), 0},
                     .steered = true,
                     .arm = {0, 2 * side * scrub, 0}});
  }
  return parts;
}

struct Vehicle : test::Scene {
  const RobotView& robot;
  Vehicle(double rate, const RobotTree& tree, Settings settings = {}, const Pose& start = {}, const Twist& moving = {})
      : robot(add("car", tree, start, moving)) {
    use("motion.ackermann", rate, all_robots(), std::move(settings));
    use("kinematics.direct", 2 * rate, all_robots());  // every other run sees the end of a step
    build();
  }
  Vehicle(double rate, const std::vector<Part>& parts, Settings settings = {}, const Pose& start = {},
          const Twist& moving = {})
      : Vehicle(rate, vehicle_of(parts), std::move(settings), start, moving) {}

  double& value(const std::string& joint, const Key<double>& key) {
    return world().value("car/" + joint + "_joint", key);
  }
  void steer(const std::string& wheel, double angle) {
    value(wheel + "_steering", keys::joint_position_target) = angle;
  }
  void drive(const std::string& wheel, double speed) { value(wheel + "_wheel", keys::joint_velocity_target) = speed; }
  double turned(const std::string& wheel) { return value(wheel + "_wheel", keys::joint_position); }
  double turning(const std::string& wheel) { return value(wheel + "_wheel", keys::joint_velocity); }
  double& angle(const std::string& wheel) { return value(wheel + "_steering", keys::joint_position); }
  Pose& at() { return pose(robot); }
  Twist& moving() { return twist(robot); }
  double yaw() { return yaw_of(at().orientation); }
  /// m/s of the lowest point of a wheel: 0 when it rolls.
  Vec3 slip(const Part& p) {
    return world().value("car/" + p.name + "_wheel", keys::twist).at(at().orientation * Vec3(0, 0, -p.radius));
  }
};

struct Draw {
  std::mt19937 engine;
  double operator()(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine); }
  Vec3 vector(double most) { return {(*this)(-most, most), (*this)(-most, most), (*this)(-most, most)}; }
};

TEST(Ackermann, TurnsOnTheCircleOfItsWheelbaseAndAngleForAnyStepSize) {
  const double radius = 2 / std::tan(0.4), angle = 0.1 * 12 * 10 / radius;
  for (const double rate : {0.1, 1.0, 3.0, 10.0, 1000.0}) {
    Vehicle s(rate, bicycle(2));
    s.steer("front", 0.4);
    s.drive("rear", 12);
    s.run_for(10);
    EXPECT_NEAR(s.at().position.x(), radius * std::sin(angle), 1e-12) << rate << " Hz";
    EXPECT_NEAR(s.at().position.y(), radius * (1 - std::cos(angle)), 1e-12) << rate << " Hz";
    EXPECT_NEAR(std::remainder(s.yaw() - angle, 2 * M_PI), 0, 1e-12) << rate << " Hz";
    EXPECT_NEAR(s.turned("rear"), 120, 1e-10);
    EXPECT_NEAR(s.turned("front"), 10 * std::hypot(radius, 2) * angle, 1e-10) << "rolls on a circle of its own";
    EXPECT_NEAR(s.turning("front"), std::hypot(radius, 2) * angle, 1e-12);
    EXPECT_EQ(s.angle("front"), 0.4);
  }
}

TEST(Ackermann, StraightWheelsDriveStraight) {
  Vehicle s(100, car(0.3, 0.2, 0.02));
  s.drive("rear_left", 10), s.drive("rear_right", 10);
  s.run_for(10);
  EXPECT_NEAR(s.at().position.x(), 10, 1e-12);
  EXPECT_EQ(s.at().position.y(), 0);
  EXPECT_EQ(s.yaw(), 0);
  EXPECT_NEAR(s.turned("front_left"), 100, 1e-11);
}

TEST(Ackermann, FourWheelsAtAnglesThatFitRollWithoutSlip) {
  Draw draw{std::mt19937(1)};
  for (int round = 0; round < 20; ++round) {
    const double wheelbase = draw(0.2, 3), track = draw(0.2, 2), turn = draw(-1, 1), scrub = draw(0, 0.05);
    const double radius = (draw(0, 1) < 0.5 ? -1 : 1) * (track + draw(0.1, 20));
    std::vector<Part> parts = car(wheelbase, track, scrub);
    for (Part& p : parts) p.radius = draw(0.05, 0.2), p.axis.y() = draw(-1, 1) < 0 ? -1 : 1, p.at.z() = p.radius;
    for (Part& p : parts) p.upright.z() = draw(-1, 1) < 0 ? -2 : 1;
    Vehicle s(50, parts, {}, {draw.vector(2), rotation_of(draw.vector(2))});
    for (const Part& p : parts) {
      const double y = p.at.y();  // cot(angle) = (radius - y) / wheelbase
      if (p.steered)
        s.steer(p.name, p.upright.z() / std::abs(p.upright.z()) * std::atan(wheelbase / (radius - y)));
      else
        s.drive(p.name, p.axis.y() * turn * (radius - y) / p.radius);
    }
    s.run_for(0.22);
    const Twist& v = s.moving();
    EXPECT_NEAR(v.linear.norm(), std::abs(turn * radius), 1e-12);
    EXPECT_NEAR((s.at().orientation.conjugate() * v.angular).z(), turn, 1e-12);
    for (const Part& p : parts) EXPECT_LT(s.slip(p).norm(), 1e-12) << p.name << " in round " << round;
  }
}

/// Where a bicycle ends whose steering and wheel go evenly from 0 to `angle` and `speed` (m/s) until `until`, then
/// stay: the equations of the bicycle by Simpson's rule.
Vec3 bicycle_end(double wheelbase, double angle, double angle_until, double speed, double speed_until,
                 double duration) {
  const auto v = [&](double t) { return speed * std::min(1.0, t / speed_until); };
  const auto turn = [&](double t) { return v(t) * std::tan(angle * std::min(1.0, t / angle_until)) / wheelbase; };
  const int n = 200000;
  const double h = duration / n;
  Vec3 sum = Vec3::Zero(), f = Vec3(v(0), 0, 0);
  double heading = 0;
  for (int i = 0; i < n; ++i) {
    const double t = h * i, a = turn(t), m = turn(t + 0.5 * h), b = turn(t + h);
    const double middle = heading + h / 24 * (5 * a + 8 * m - b), end = heading + h / 6 * (a + 4 * m + b);
    const double vm = v(t + 0.5 * h), ve = v(t + h);
    const Vec3 g = ve * Vec3(std::cos(end), std::sin(end), 0);
    sum += h / 6 * (f + 4 * vm * Vec3(std::cos(middle), std::sin(middle), 0) + g);
    f = g, heading = end;
  }
  return {sum.x(), sum.y(), heading};
}

TEST(Ackermann, SteeringOnTheWayIsExactForAnyStepSize) {
  const Vec3 expected = bicycle_end(0.5, 0.6, 1.2, 2, 2.5, 4);
  for (const double rate : {0.25, 1.25, 7.0, 100.0, 1000.0}) {
    Vehicle s(rate, bicycle(0.5), {{"max_steering_rate", 0.5}, {"max_wheel_acceleration", 8.0}});
    s.steer("front", 0.6);
    s.drive("rear", 20);
    s.run_for(4);
    EXPECT_NEAR(s.at().position.x(), expected.x(), 1e-10) << rate << " Hz";
    EXPECT_NEAR(s.at().position.y(), expected.y(), 1e-10) << rate << " Hz";
    EXPECT_NEAR(std::remainder(s.yaw() - expected.z(), 2 * M_PI), 0, 1e-10) << rate << " Hz";
  }
}

TEST(Ackermann, AtAConstantAngleSpeedingUpKeepsToTheCircle) {
  for (const double rate : {0.5, 40.0}) {
    Vehicle s(rate, bicycle(1), {{"max_wheel_acceleration", 3.0}});
    s.steer("front", -0.7);
    s.drive("rear", 9);
    s.run_for(4);
    const double radius = -1 / std::tan(0.7), way = 0.1 * (0.5 * 3 * 9 + 9), angle = way / radius;
    EXPECT_NEAR(s.at().position.x(), radius * std::sin(angle), 1e-12);
    EXPECT_NEAR(s.at().position.y(), radius * (1 - std::cos(angle)), 1e-12);
  }
}

TEST(Ackermann, WheelsOnArmsRollWithoutSlipWhileTheyAreSteered) {
  Draw draw{std::mt19937(2)};
  for (int round = 0; round < 10; ++round) {
    const std::vector<Part> parts = {
        {.name = "fixed", .at = {0, -0.3, 0.1}},
        {.name = "steered", .at = {1, 0.3, 0.1}, .steered = true, .arm = {draw(-0.1, 0.1), draw(-0.1, 0.1), 0}}};
    Vehicle s(20, parts, {{"max_steering_rate", draw(0.1, 1)}, {"max_wheel_acceleration", 100.0}});
    s.steer("steered", draw(-1, 1));
    s.drive("fixed", draw(-20, 20));
    s.run_for(0.05);
    for (int step = 0; step < 4; ++step) {
      s.run_for(0.05);
      for (const Part& p : parts) EXPECT_LT(s.slip(p).norm(), 1e-12) << p.name << " in round " << round;
    }
  }
}

TEST(Ackermann, TwistIsTheDerivativeOfPoseAndWheelsTurnAsFastAsTheySay) {
  std::vector<Part> parts = car(1, 0.6, 0.1);
  for (Part& p : parts) p.arm.x() = p.steered ? -0.05 : 0;
  Vehicle s(1e4, parts, {{"max_steering_rate", 0.8}, {"max_wheel_acceleration", 5.0}});
  for (const char* end : {"left", "right"}) {
    s.steer(std::string("front_") + end, 0.5);
    s.drive(std::string("rear_") + end, 20);
  }
  s.run_for(0.3);
  const Pose before = s.at();
  const Twist v = s.moving();
  const double wheel = s.turned("front_left"), speed = s.turning("front_left");
  s.run_for(1e-4);
  EXPECT_LT(((s.at().position - before.position) / 1e-4 - 0.5 * (v.linear + s.moving().linear)).norm(), 1e-7);
  EXPECT_NEAR(yaw_of(before.orientation.conjugate() * s.at().orientation) / 1e-4,
              0.5 * (v.angular + s.moving().angular).z(), 1e-7);
  EXPECT_NEAR((s.turned("front_left") - wheel) / 1e-4, 0.5 * (speed + s.turning("front_left")), 1e-6);
}

TEST(Ackermann, ATricycleDrivenAndSteeredInFrontTurnsOnTheSpot) {
  std::vector<Part> parts = {
      {.name = "front", .at = {0.8, 0, 0}, .steered = true, .steering = {.lower = -2, .upper = 2}},
      {.name = "left", .at = {0, 0.3, 0}},
      {.name = "right", .at = {0, -0.3, 0}}};
  Vehicle s(10, parts, {{"driven", Names{"front_wheel_joint"}}});
  s.steer("front", M_PI / 2);
  s.drive("front", 4);
  s.run_for(2);
  EXPECT_LT(s.at().position.norm(), 1e-12);
  EXPECT_NEAR(s.yaw(), 0.1 * 4 * 2 / 0.8, 1e-12);
  EXPECT_NEAR(s.turned("left"), -s.yaw() * 0.3 / 0.1, 1e-11);
  EXPECT_NEAR(s.turned("right"), s.yaw() * 0.3 / 0.1, 1e-11);
}

TEST(Ackermann, SteeredBehindItTurnsTheOtherWay) {
  Vehicle s(10, {{.name = "front", .at = {0, 0, 0}}, {.name = "rear", .at = {-1.5, 0, 0}, .steered = true}});
  s.steer("rear", 0.3);
  s.drive("front", 5);
  s.run_for(1);
  EXPECT_NEAR(s.yaw(), -0.5 * std::tan(0.3) / 1.5, 1e-13);
}

TEST(Ackermann, AllWheelsSteeredAlikeMoveItSidewaysWithoutTurning) {
  std::vector<Part> parts = car(1, 0.6);
  for (Part& p : parts) p.steered = true;
  Vehicle s(10, parts);
  for (const Part& p : parts) s.steer(p.name, 0.9), s.drive(p.name, 7);
  s.run_for(2);
  EXPECT_LT((s.at().position - 1.4 * Vec3(std::cos(0.9), std::sin(0.9), 0)).norm(), 1e-12);
  EXPECT_NEAR(s.yaw(), 0, 1e-13);
}

TEST(Ackermann, SteeringKeepsItsRateAndItsLimits) {
  std::vector<Part> parts = bicycle(1);
  parts[1].steering = {.lower = -0.3, .upper = 0.5, .velocity = 2};
  for (const double most : {1e9, 0.5}) {
    Vehicle s(10, parts, {{"max_steering_rate", most}});
    const double rate = std::min(most, 2.0);
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
  std::vector<Part> parts = bicycle(1);
  parts[0].wheel.velocity = 5;
  Vehicle s(100, parts, {{"max_wheel_acceleration", 2.0}});
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
  std::vector<Part> parts = car(1, 0.6);
  parts[3].leader = "front_left_steering_joint";
  Vehicle linked(10, parts), free(10, car(1, 0.6));
  for (Vehicle* s : {&linked, &free}) s->steer("front_left", 0.3), s->drive("rear_left", 5), s->drive("rear_right", 5);
  free.steer("front_right", 0.3);
  linked.run_for(1), free.run_for(1);
  EXPECT_EQ(linked.angle("front_right"), 0.3);
  EXPECT_LT((linked.at().position - free.at().position).norm(), 1e-13);
  EXPECT_GT(linked.yaw(), 0.1);

  for (Part& p : parts)
    if (p.steered) p.leader = "steering_wheel_joint", p.multiplier = 1.0 / 15;
  const auto column = [](RobotBuilder& b) {
    b.translation({0.5, 0, 0.5});
    b.revolute("steering_wheel_joint", Vec3::UnitX(), {.lower = -9, .upper = 9, .velocity = 3});
    b.body("steering_wheel");
  };
  Vehicle geared(10, vehicle_of(parts, column));
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
  std::vector<Part> parts = bicycle(2);
  RobotTree tree = vehicle_of(parts);
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
  for (const auto& instance : s.instances())
    if (instance->setup().use == "motion.ackermann") instance->take_over(0);
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

std::string complaint(const RobotTree& tree, Settings settings = {}) {
  try {
    Vehicle s(10, tree, std::move(settings));
  } catch (const SetupError& e) {
    return e.what();
  }
  return "no complaint";
}
#define EXPECT_SAYS(TEXT, PART) EXPECT_NE((TEXT).find(PART), std::string::npos) << (TEXT)

TEST(Ackermann, AVehicleWithoutSteeredWheelsIsAnErrorThatTellsWhatItHas) {
  const std::string text = complaint(test::two_wheeler(0.05, 0.3));
  EXPECT_SAYS(
      text,
      "`car` has no steered wheels: `left_joint` is a wheel that is not steered; `right_joint` is a wheel that is "
      "not steered. Name the joints that steer with `steering`; a vehicle that turns by the speeds of its wheels "
      "is one for motion.differential_drive or motion.omni and their drives");
}

TEST(Ackermann, ASwivelWithoutLimitsIsACasterUnlessItIsNamed) {
  std::vector<Part> parts = bicycle(1);
  parts[1].steering = {};
  EXPECT_SAYS(complaint(vehicle_of(parts)), "`front_wheel_joint` swivels about `front_steering_joint` as casters do");
  EXPECT_EQ(complaint(vehicle_of(parts), {{"steering", Names{"front_steering_joint"}}}), "no complaint");
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
  std::vector<Part> parts = bicycle(1);
  parts[1].steering = {.lower = 0.1, .upper = 0.5};
  EXPECT_SAYS(complaint(vehicle_of(parts)),
              "joint `car/front_steering_joint` starts at 0.000000, outside of its limits");
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
