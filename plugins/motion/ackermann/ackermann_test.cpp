// SPDX-License-Identifier: MIT
// Tests of a vehicle's path: closed forms, and wheels that do not slip.
#include <gtest/gtest.h>

#include "ackermann_testing.hpp"
#include "muro/toolkit/rotations.hpp"

namespace muro {
namespace {

using namespace ackermann;

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
    std::vector<WheelSpec> wheels = car(wheelbase, track, scrub);
    for (WheelSpec& p : wheels) p.radius = draw(0.05, 0.2), p.axis.y() = draw(-1, 1) < 0 ? -1 : 1, p.at.z() = p.radius;
    for (WheelSpec& p : wheels) p.upright.z() = draw(-1, 1) < 0 ? -2 : 1;
    Vehicle s(50, wheels, {}, {draw.vector(2), rotation_of(draw.vector(2))});
    for (const WheelSpec& p : wheels) {
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
    for (const WheelSpec& p : wheels) EXPECT_LT(s.slip(p).norm(), 1e-12) << p.name << " in round " << round;
  }
}

/// Returns the end of a bicycle's path, from the bicycle's equations by Simpson's rule. Steering and wheel change
/// evenly from 0 to `angle` and `speed` (m/s) until `angle_until` and `speed_until`, then stay.
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
    const std::vector<WheelSpec> wheels = {
        {.name = "fixed", .at = {0, -0.3, 0.1}},
        {.name = "steered", .at = {1, 0.3, 0.1}, .steered = true, .arm = {draw(-0.1, 0.1), draw(-0.1, 0.1), 0}}};
    Vehicle s(20, wheels, {{"max_steering_rate", draw(0.1, 1)}, {"max_wheel_acceleration", 100.0}});
    s.steer("steered", draw(-1, 1));
    s.drive("fixed", draw(-20, 20));
    s.run_for(0.05);
    for (int step = 0; step < 4; ++step) {
      s.run_for(0.05);
      for (const WheelSpec& p : wheels) EXPECT_LT(s.slip(p).norm(), 1e-12) << p.name << " in round " << round;
    }
  }
}

TEST(Ackermann, TwistIsTheDerivativeOfPoseAndWheelsTurnAsFastAsTheySay) {
  std::vector<WheelSpec> wheels = car(1, 0.6, 0.1);
  for (WheelSpec& p : wheels) p.arm.x() = p.steered ? -0.05 : 0;
  Vehicle s(1e4, wheels, {{"max_steering_rate", 0.8}, {"max_wheel_acceleration", 5.0}});
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
  std::vector<WheelSpec> wheels = {
      {.name = "front", .at = {0.8, 0, 0}, .steered = true, .steering = {.lower = -2, .upper = 2}},
      {.name = "left", .at = {0, 0.3, 0}},
      {.name = "right", .at = {0, -0.3, 0}}};
  Vehicle s(10, wheels, {{"driven", Names{"front_wheel_joint"}}});
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
  std::vector<WheelSpec> wheels = car(1, 0.6);
  for (WheelSpec& p : wheels) p.steered = true;
  Vehicle s(10, wheels);
  for (const WheelSpec& p : wheels) s.steer(p.name, 0.9), s.drive(p.name, 7);
  s.run_for(2);
  EXPECT_LT((s.at().position - 1.4 * Vec3(std::cos(0.9), std::sin(0.9), 0)).norm(), 1e-12);
  EXPECT_NEAR(s.yaw(), 0, 1e-13);
}

}  // namespace
}  // namespace muro
