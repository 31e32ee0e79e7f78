// SPDX-License-Identifier: MIT
// A vehicle whose wheels are driven by efforts, on the ground of contact.penalty.
#include <gtest/gtest.h>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/scene.hpp"

namespace muro {
namespace {

using Parameters = std::map<std::string, ParameterInput>;

constexpr double g = 9.81, radius = 0.06, wheel_mass = 0.3, spin = wheel_mass * radius * radius / 2, mass = 5.2;
const std::vector<std::string> wheels{"front_left", "front_right", "rear_left", "rear_right"};

RobotTree rover(double friction, const JointLimits& limits) {
  return test::tree_of([&](RobotBuilder& b) {
    b.base("chassis");
    b.set(keys::inertial, Inertia{.mass = 4, .ixx = 0.0256, .iyy = 0.0456, .izz = 0.0617});
    Shape chassis = Shape::box({0.35, 0.25, 0.12});
    chassis.surface.friction = friction;
    b.set_array(keys::collision_shapes, std::span<const Shape>(&chassis, 1));
    for (std::size_t k = 0; k < 4; ++k) {
      if (k < 3) b.fork();
      b.translation({k < 2 ? 0.12 : -0.12, k % 2 == 0 ? 0.15 : -0.15, -0.03});
      b.revolute(wheels[k] + "_joint", Vec3::UnitY(), limits);
      b.body(wheels[k]);
      b.set(keys::inertial, Inertia{.mass = wheel_mass, .ixx = 0.00031, .iyy = spin, .izz = 0.00031});
      Shape tyre = Shape::cylinder(radius, 0.04);
      tyre.surface.friction = friction;
      tyre.origin.orientation = from_rpy(M_PI / 2, 0, 0);
      b.set_array(keys::collision_shapes, std::span<const Shape>(&tyre, 1));
      if (k < 3) b.end();
    }
    for (int k = 0; k < 3; ++k) b.end();
  });
}

struct Drive : test::Scene {
  const RobotView* robot;
  explicit Drive(const Parameters& parameters, double friction = 0.8, const Quat& tilt = Quat::Identity(),
                 const JointLimits& limits = {}, double wall = 0, double rate = 1000) {
    add_ground(friction, {Vec3::Zero(), tilt});
    if (wall > 0) {
      const Shape box = Shape::box({0.4, 10, 1});
      world().add_scenery("wall", {{wall + 0.2, 0, 0.5}, Quat::Identity()}, std::span<const Shape>(&box, 1));
    }
    robot = &add("r", rover(friction, limits), {tilt * Vec3(0, 0, 0.0899), tilt});
    use("motion.simplified", rate, all_robots(), parameters);
    use_contacts();
    build();
  }
  void set(const Key<double>& target, double value) {
    for (const std::string& w : wheels) world().value("r/" + w + "_joint", target) = value;
  }
  double wheel(const Key<double>& key) { return world().value("r/front_left_joint", key); }
  double forward() {
    const Pose& p = pose(*robot);
    return twist(*robot).linear.dot(p.orientation * Vec3::UnitX());
  }
};

TEST(DrivenVehicle, AcceleratesByTheEffortOfItsWheels) {
  // 4 M / r = (m + 4 I / r^2) a
  Drive s(Parameters{{"joints", "effort"}});
  s.run_for(0.5);
  s.set(keys::joint_effort_target, 0.1);
  s.run_for(0.2);
  const double before = s.forward(), turning = s.wheel(keys::joint_velocity);
  s.run_for(1);
  const double a = 4 * 0.1 / radius / (mass + 4 * spin / (radius * radius));
  EXPECT_NEAR(s.forward() - before, a, 0.005 * a);
  EXPECT_NEAR((s.wheel(keys::joint_velocity) - turning) * radius, a, 0.01 * a) << "it rolls, half its depth lower";
}

TEST(DrivenVehicle, NoMoreEffortReachesTheGroundThanFrictionCarries) {
  Drive s(Parameters{{"joints", "effort"}}, 0.3);
  s.run_for(0.5);
  s.set(keys::joint_effort_target, 0.6);  // 40 N against 15.3 N of friction
  s.run_for(0.2);
  const double before = s.forward();
  s.run_for(0.5);
  EXPECT_NEAR(s.forward() - before, 0.5 * 0.3 * g, 0.01 * 0.5 * 0.3 * g);
  EXPECT_GT(s.wheel(keys::joint_velocity) * radius, 3 * s.forward()) << "wheels spin";
}

TEST(DrivenVehicle, RollsDownASlopeOnPassiveWheels) {
  const double angle = 0.1;
  Drive s(Parameters{{"joints", "passive"}}, 0.8, from_rpy(0, angle, 0));
  s.run_for(0.5);
  const double before = s.forward();
  s.run_for(1);
  const double a = g * std::sin(angle) * mass / (mass + 4 * spin / (radius * radius));
  EXPECT_NEAR(s.forward() - before, a, 0.005 * a);
}

TEST(DrivenVehicle, StandsOnASlopeByTheFrictionOfItsDrives) {
  const double angle = 0.1, needed = mass * g * std::sin(angle) * radius / 4;
  for (const double share : {0.9, 1.1}) {
    Drive s(Parameters{{"joints", "passive"}}, 0.8, from_rpy(0, angle, 0), {.friction = needed / share});
    s.run_for(1);
    const Vec3 before = s.pose(*s.robot).position;
    s.run_for(2);
    const double way = (s.pose(*s.robot).position - before).norm();
    if (share < 1)
      EXPECT_LT(way, 1e-6);
    else
      EXPECT_GT(way, 0.05);
  }
}

TEST(DrivenVehicle, AWallStallsADriveWhoseEffortIsLimited) {
  for (const bool limited : {false, true}) {
    Drive s(Parameters{{"effort_limits", limited}}, 0.8, Quat::Identity(), {.effort = 0.2}, 0.6);
    s.set(keys::joint_velocity_target, 10);
    s.run_for(4);
    if (limited) {
      EXPECT_LT(std::abs(s.wheel(keys::joint_velocity)), 0.01) << "4 * 0.2 / 0.06 = 13 N, held by friction";
      EXPECT_NEAR(s.wheel(keys::joint_effort), 0.2, 1e-9);
    } else {
      EXPECT_EQ(s.wheel(keys::joint_velocity), 10);
    }
    EXPECT_NEAR(s.pose(*s.robot).position.x(), 0.6 - 0.18, 0.005);
  }
}

TEST(DrivenVehicle, StandsStillAtAnyRate) {
  for (const double rate : {1000.0, 500.0, 250.0}) {
    Drive s(Parameters{{"joints", "effort"}}, 0.8, Quat::Identity(), {}, 0, rate);
    s.run_for(1);
    const Vec3 before = s.pose(*s.robot).position;
    s.run_for(4);
    // its wheels turn freely, so it keeps the speed that it gets while contacts adapt to their load
    EXPECT_LT((s.pose(*s.robot).position - before).norm(), rate < 1000 ? 1e-5 : 1e-6) << rate;
    EXPECT_LT(std::abs(s.wheel(keys::joint_velocity)), 1e-4) << rate;
  }
}

}  // namespace
}  // namespace muro
