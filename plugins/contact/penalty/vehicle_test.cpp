// SPDX-License-Identifier: MIT
// A four-wheeled vehicle on contact.penalty and motion.simplified.
#include <gtest/gtest.h>

#include "muro/toolkit/rotations.hpp"
#include "penalty_testing.hpp"

namespace muro {
namespace {

using namespace test;

struct Drive : ContactScene {
  const RobotView* robot;
  explicit Drive(double friction = 0.8, double rate = 1000, const Twist& twist = {}) {
    add_ground(friction);
    robot = &add("r", rover(friction), {{0, 0, 0.09}, Quat::Identity()}, twist);
    start(rate);
  }
};

TEST(Vehicle, StandsStillForAMinute) {
  Drive s;
  s.run_for(1);
  const Pose before = s.pose(*s.robot);
  s.run_for(59);
  const Pose after = s.pose(*s.robot);
  EXPECT_LT((after.position - before.position).norm(), 1e-9);
  EXPECT_LT(after.orientation.angularDistance(before.orientation), 1e-9);
  // It sinks g / omega^2, times the softening that stability requires.
  const double sag = 0.09 - after.position.z(), omega = 2 * M_PI * 50;
  EXPECT_GT(sag, g / (omega * omega));
  EXPECT_LT(sag, 2 * g / (omega * omega));
}

TEST(Vehicle, DrivesAtTheSpeedOfItsWheels) {
  Drive s;
  s.wheels("r", 10, 10);
  s.run_for(1);
  const double start = s.pose(*s.robot).position.x();
  s.run_for(5);
  EXPECT_NEAR(s.pose(*s.robot).position.x() - start, 5 * 0.6, 0.006);  // rolls half its depth lower
  EXPECT_NEAR(s.pose(*s.robot).position.y(), 0, 1e-6);
}

TEST(Vehicle, SkidSteeringTurnsLessThanTheKinematicModel) {
  Drive s;
  s.wheels("r", -8, 8);
  s.run_for(1);
  const double kinematic = 16 * 0.06 / 0.3;
  EXPECT_LT(s.twist(*s.robot).angular.z(), 0.9 * kinematic);
  EXPECT_GT(s.twist(*s.robot).angular.z(), 0.3 * kinematic);
  EXPECT_LT(s.pose(*s.robot).position.head<2>().norm(), 0.01);
  s.wheels("r", 4, 8);
  s.run_for(3);
  EXPECT_GT(s.twist(*s.robot).angular.z(), 0.1);
  EXPECT_NEAR(s.twist(*s.robot).linear.norm(), 6 * 0.06, 0.02);  // the mean of both sides
}

TEST(Vehicle, BrakesInTheTextbookDistance) {
  Drive s(0.8, 1000, {{3, 0, 0}, {0, 0, 0}});  // its wheels do not turn
  s.run_for(2);
  EXPECT_NEAR(s.pose(*s.robot).position.x(), 3 * 3 / (2 * 0.8 * g), 0.006);
  EXPECT_LT(s.twist(*s.robot).linear.norm(), 1e-6);
}

TEST(Vehicle, HoldsOnASlopeUpToTheAngleOfFrictionInAnyHeading) {
  for (const double yaw : {0.0, 0.7, M_PI / 2})
    for (const double share : {0.98, 1.02}) {
      ContactScene s;
      const Quat tilt = from_rpy(0, std::atan(share * 0.8), 0);
      s.add_ground(0.8, {Vec3::Zero(), tilt});
      const RobotView& r = s.add("r", rover(0.8), {tilt * Vec3(0, 0, 0.09), tilt * from_rpy(0, 0, yaw)});
      s.start();
      s.run_for(1);
      const Vec3 before = s.pose(r).position;
      s.run_for(3);
      const double way = (s.pose(r).position - before).norm();
      if (share < 1)
        EXPECT_LT(way, 1e-9) << yaw;
      else
        EXPECT_GT(way, 0.3) << yaw;
    }
}

TEST(Vehicle, AxleLoadsOnASlopeAreThoseOfStatics) {
  // Front and rear: m g (b cos -+ h sin) / (a + b), a = b = 0.12; h: centre of mass over the ground. Depths are in the
  // ratio of loads.
  ContactScene s;
  const double angle = 0.3, raised = 0.05;
  const Quat tilt = from_rpy(0, -angle, 0);  // nose up
  s.add_ground(0.8, {Vec3::Zero(), tilt});
  const RobotView& r = s.add("r", rover(0.8, raised), {tilt * Vec3(0, 0, 0.09), tilt});
  s.start();
  s.run_for(2);
  const double h = (4 * (0.09 + raised) + 1.2 * 0.06) / 5.2, b = 0.12;
  double front = 0, rear = 0;
  for (const Contact& c : s.contacts(r)) (tilt.conjugate() * c.point).x() > 0 ? front += c.depth : rear += c.depth;
  EXPECT_NEAR(front / rear, (b * std::cos(angle) - h * std::sin(angle)) / (b * std::cos(angle) + h * std::sin(angle)),
              0.005);
  const Wrench all = s.external(r);
  EXPECT_NEAR(all.force.z(), 5.2 * g, 1e-6);
  EXPECT_LT(all.force.head<2>().norm(), 1e-6);
}

TEST(Vehicle, TipsOverWhereItsCentreOfMassLeavesItsWheels) {
  const double raised = 0.25, h = (4 * (0.09 + raised) + 1.2 * 0.06) / 5.2;  // tan = b / h = 0.435
  for (const double share : {0.9, 1.1}) {
    ContactScene s;
    const Quat tilt = from_rpy(0, -std::atan(share * 0.12 / h), 0);
    s.add_ground(1.5, {Vec3::Zero(), tilt});
    const RobotView& r = s.add("r", rover(1.5, raised), {tilt * Vec3(0, 0, 0.09), tilt});
    s.start();
    s.run_for(4);
    const double lean = (tilt.conjugate() * s.pose(r).orientation).angularDistance(Quat::Identity());
    if (share < 1)
      EXPECT_LT(lean, 0.01);
    else
      EXPECT_GT(lean, 0.5);
  }
}

TEST(Vehicle, PushesAgainstAWallForMinutesWithoutClimbingIt) {
  // Friction 0.4: by statics the wall lifts the nose with mu^2 m g / (1 + mu^2) at 0.3 m, far less than the weight
  // holds down.
  ContactScene s;
  s.add_ground(0.4);
  s.add_box("wall", {1.2, 0, 0.5}, {0.4, 10, 1}, 0.4);
  const RobotView& r = s.add("r", rover(0.4), {{0, 0, 0.09}, Quat::Identity()});
  s.start();
  s.wheels("r", 10, 10);
  s.run_for(5);
  const Pose blocked = s.pose(r);
  for (int k = 0; k < 12; ++k) {
    s.run_for(10);
    EXPECT_LT((s.pose(r).position - blocked.position).norm(), 1e-3);
    EXPECT_LT(s.pose(r).orientation.angularDistance(blocked.orientation), 0.01);
  }
  EXPECT_NEAR(blocked.position.x(), 1 - 0.18, 0.002);
  EXPECT_NEAR(blocked.position.z(), 0.09, 0.001);
  s.wheels("r", -10, -10);
  s.run_for(2);
  EXPECT_LT(s.pose(r).position.x(), 0.1);
}

TEST(Vehicle, IsStableAtLowRates) {
  for (const double rate : {500.0, 250.0, 100.0}) {
    Drive s(0.8, rate);
    s.wheels("r", 6, 10);
    for (int k = 0; k < 50; ++k) {
      s.run_for(0.1);
      const double height = s.pose(*s.robot).position.z();
      ASSERT_NEAR(height, 0.09, 0.001 + 4 * g / (0.36 * rate * rate)) << rate;  // softer the longer the step
      ASSERT_GT((s.pose(*s.robot).orientation * Vec3::UnitZ()).z(), 0.995) << rate;
    }
    s.wheels("r", 0, 0);
    s.run_for(2);
    EXPECT_LT(s.twist(*s.robot).linear.norm(), 1e-6) << rate;
  }
}

TEST(Vehicle, FallingFromAMetreItComesToRestOnItsWheels) {
  ContactScene s;
  s.add_ground();
  const RobotView& r = s.add("r", rover(0.8), {{0, 0, 1}, from_rpy(0.3, 0.2, 0)}, {{1, 0, 0}, {0, 0, 2}});
  s.start();
  s.run_for(5);
  EXPECT_NEAR(s.pose(r).position.z(), 0.09, 0.001);
  EXPECT_LT(s.twist(r).linear.norm() + s.twist(r).angular.norm(), 1e-9);
}

}  // namespace
}  // namespace muro
