// SPDX-License-Identifier: MIT
// Force and torque in a joint: they act from what lies beyond it on what carries it, at the device, in its axes. Other
// simulators had a fault in each of the three (sdformat 130, gazebo-yarp-plugins 73 and 480).
#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/sensor/case.hpp"

namespace muro::sensor_conformance {

namespace {

constexpr double mass = 0.5, arm = 0.3;
const Trial::Parameters held{{"base", "fixed"}, {"joints", "velocity"}, {"max_joint_acceleration", 1e9}};
const Trial::Parameters loose{{"base", "fixed"}, {"joints", "passive"}};

Wrench reading(Trial& t, ObjectId sensor) { return t.world().value(sensor, keys::sensed_wrench); }

Outcome both(const Wrench& seen, const Vec3& force, const Vec3& torque) {
  const Outcome f = difference(seen.force, force), m = difference(seen.torque, torque);
  return {std::max(f.error, m.error), f.seen + ", " + m.seen};
}

Outcome held_arm(const std::string& motion) {
  Trial t(motion);
  const double q = 0.4, weight = mass * g;
  t.add_arm(Vec3::UnitY(), q);
  const ObjectId s = t.add_sensor("sensor.force_torque", "lift");
  t.start(held);
  t.run_for(0.1005);
  return both(reading(t, s), weight * Vec3(std::sin(q), 0, -std::cos(q)), {0, weight * arm * std::cos(q), 0});
}

/// A device shifted by r: the torque changes by -r x F. A turned device: both are given in its own axes.
Outcome shifted_and_turned(const std::string& motion) {
  Trial t(motion);
  const double q = 0.4, weight = mass * g;
  const Vec3 r(0.1, 0.05, 0.02);
  const Quat axes = from_rpy(0.3, -0.4, 0.5);
  t.add_arm(Vec3::UnitY(), q);
  const ObjectId s =
      t.add_sensor("sensor.force_torque", "lift",
                   {{"offset", std::vector<double>{0.1, 0.05, 0.02}}, {"rpy", std::vector<double>{0.3, -0.4, 0.5}}});
  t.start(held);
  t.run_for(0.1005);
  const Vec3 force = weight * Vec3(std::sin(q), 0, -std::cos(q));
  const Vec3 torque = Vec3(0, weight * arm * std::cos(q), 0) - r.cross(force);
  return both(reading(t, s), axes.conjugate() * force, axes.conjugate() * torque);
}

/// An arm that turns about the vertical at 4 rad/s: outward m w^2 l, and its weight.
Outcome whirled_arm(const std::string& motion) {
  Trial t(motion);
  t.add_arm(Vec3::UnitZ(), 0);
  const ObjectId s = t.add_sensor("sensor.force_torque", "lift");
  t.start(held);
  t.joint("lift", keys::joint_velocity_target) = 4;
  t.run_for(0.4005);
  return both(reading(t, s), {mass * 16 * arm, 0, -mass * g}, {0, mass * g * arm, 0});
}

/// Returns the force at the pivot, as a fraction of the weight, after a swing of `angle` (rad) from level.
Vec3 swinging(const std::string& motion, const Inertia& bob, double angle) {
  Trial t(motion);
  t.add("r", test::tree_of([&](RobotBuilder& b) {
          b.base("base_link");
          b.set(keys::inertial, test::solid_box(2, {0.4, 0.3, 0.2}));
          b.revolute("pivot", Vec3::UnitY(), {});
          b.body("rod");
          b.set(keys::inertial, bob);
        }),
        {{0, 0, 3}, Quat::Identity()});
  const ObjectId s = t.add_sensor("sensor.force_torque", "pivot");
  t.start(loose);
  while (t.joint("pivot", keys::joint_position) < angle && t.now() < 3'000'000'000) t.run_for(0.001);
  t.run_for(0.0005);
  return reading(t, s).force / (bob.mass * g);
}
const Inertia uniform_rod{.mass = 1, .com = {0.5, 0, 0}, .ixx = 1e-4, .iyy = 1.0 / 12, .izz = 1.0 / 12};
Outcome point_pendulum(const std::string& motion) {
  const Inertia bob{.mass = 1, .com = {0.5, 0, 0}, .ixx = 1e-6, .iyy = 1e-6, .izz = 1e-6};
  return difference(swinging(motion, bob, M_PI / 2).norm(), 3);
}
Outcome rod_pendulum(const std::string& motion) {
  return difference(swinging(motion, uniform_rod, M_PI / 2).norm(), 2.5);
}
/// Checks the force across a rod at 45 deg from the bottom: m g sin q / 4.
Outcome rod_across(const std::string& motion) {
  return difference(std::abs(swinging(motion, uniform_rod, M_PI / 4).z()), std::sqrt(0.5) / 4);
}

/// Checks a sensor on a foot with a fixed joint: it carries the weight above. Other simulators merge such joints.
Outcome standing(const std::string& motion) {
  Trial t(motion);
  t.add_ground();
  const Shape sole = test::with(Shape::box({0.3, 0.2, 0.04}), 0.8);
  t.add("r", test::tree_of([&](RobotBuilder& b) {
          b.base("trunk");
          b.set(keys::inertial, Inertia{.mass = 3, .com = {0.02, 0.01, 0}, .ixx = 0.03, .iyy = 0.03, .izz = 0.03});
          b.translation({0, 0, -0.2});
          b.body("foot");
          b.set(keys::inertial, test::solid_box(0.5, {0.3, 0.2, 0.04}));
          b.set_array(keys::collision_shapes, std::span<const Shape>(&sole, 1));
        }),
        {{0, 0, 0.22}, Quat::Identity()});
  const ObjectId s = t.add_sensor("sensor.force_torque", "foot");
  t.start();
  t.run_for(1.0005);
  return both(reading(t, s), {0, 0, 3 * g}, Vec3(0.02, 0.01, 0).cross(Vec3(0, 0, 3 * g)));
}

constexpr How a = How::analytic, d = How::differenced, none = How::left_out;

}  // namespace

std::vector<Case> wrench_cases() {
  return {
      {"a held arm weighs on its joint", "sensor.force_torque", "N, N m", {a, a, d}, {1e-9, 1e-9, 1e-5}, held_arm},
      {"a shifted and turned device reads r x F more, in its axes",
       "sensor.force_torque",
       "N, N m",
       {a, a, d},
       {1e-9, 1e-9, 1e-5},
       shifted_and_turned},
      {"a whirled arm pulls with m w^2 l", "sensor.force_torque", "N, N m", {a, a, d}, {1e-9, 1e-9, 1e-5}, whirled_arm},
      {"a pendulum pulls with 3 m g at the bottom",
       "sensor.force_torque",
       "m g",
       {none, none, d},
       {0, 0, 0.03},
       point_pendulum},
      {"a rod pulls with 2.5 m g at the bottom",
       "sensor.force_torque",
       "m g",
       {none, none, d},
       {0, 0, 0.025},
       rod_pendulum},
      {"a rod that swings bears with m g sin q / 4 across",
       "sensor.force_torque",
       "m g",
       {none, none, d},
       {0, 0, 0.01},
       rod_across},
      {"a foot on a fixed joint carries what stands on it",
       "sensor.force_torque",
       "N, N m",
       {none, none, d},
       {0, 0, 0.3},
       standing},
  };
}

}  // namespace muro::sensor_conformance
