// SPDX-License-Identifier: MIT
// Gyroscopes and accelerometers. Isaac Sim and Isaac Lab had faults in the turning and driving cases (IsaacSim 735,
// IsaacLab 7163).
#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/sensor/case.hpp"

namespace muro::sensor_conformance {

namespace {

constexpr double radius = 0.2;  ///< m, of the sensor on the turntable
const Trial::Parameters at_radius{{"offset", std::vector<double>{radius, 0, 0}}};
const Trial::Parameters on_table{{"base", "fixed"}, {"joints", "velocity"}, {"max_joint_acceleration", 1e9}};

/// Nose up by 0.3 rad: held by the motion alone, or on a slope, where contacts that are springs give way by some 0.1
/// mrad.
Outcome tilted(const std::string& motion) {
  Trial t(motion);
  const double angle = 0.3;
  const Quat turn = from_rpy(0, -angle, 0);
  const bool falls = t.family() == Family::forces;
  if (falls) t.add_ground(0.8, {Vec3::Zero(), turn});
  t.add_vehicle({turn * Vec3(0, 0, 0.0999), turn});
  const ObjectId imu = t.add_sensor("sensor.imu", "base_link");
  t.start();
  t.run_for(falls ? 3 : 0.1);
  if (falls) return difference(t.linear_acceleration(imu), t.pose(t.robot()).orientation.conjugate() * Vec3(0, 0, g));
  return difference(t.linear_acceleration(imu), {g * std::sin(angle), 0, g * std::cos(angle)});
}

Outcome falling(const std::string& motion) {
  Trial t(motion);
  t.add("r", test::block(2, {0.1, 0.2, 0.3}, 0.5), {{0, 0, 50}, from_rpy(0.3, 0.2, 0.1)}, {{1, 2, 3}, Vec3::Zero()});
  const ObjectId f = t.add_sensor("sensor.accelerometer", t.base_name());
  t.start();
  t.run_for(0.5);
  return difference(t.linear_acceleration(f), Vec3::Zero());
}

/// Spin about an axis of inertia, with the device `r` off the centre: the reading is w x (w x r) alone.
Outcome falling_and_spinning(const std::string& motion) {
  Trial t(motion);
  const Vec3 w(0, 0, 3), r(0.1, 0.05, 0.02);
  t.add("r", test::block(2, {0.1, 0.2, 0.3}, 0.5), {{0, 0, 50}, Quat::Identity()}, {{1, 0, 0}, w});
  const ObjectId f =
      t.add_sensor("sensor.accelerometer", t.base_name(), {{"offset", std::vector<double>{r.x(), r.y(), r.z()}}});
  t.start();
  t.run_for(0.5);
  return difference(t.linear_acceleration(f), w.cross(w.cross(r)));
}

Outcome first_sample_in_the_air(const std::string& motion) {
  Trial t(motion);
  t.add_ground();
  t.add("r", test::block(2, {0.1, 0.2, 0.3}, 0.5), {{0, 0, 5}, Quat::Identity()});
  const ObjectId f = t.add_sensor("sensor.accelerometer", t.base_name());
  t.start();
  t.run_for(0.0005);
  return difference(t.linear_acceleration(f), Vec3::Zero());
}

Outcome first_sample_on_the_ground(const std::string& motion) {
  Trial t(motion);
  t.add_ground();
  t.add_vehicle({{0, 0, 0.1}, Quat::Identity()});
  const ObjectId f = t.add_sensor("sensor.accelerometer", "base_link");
  t.start();
  t.run_for(0.0005);
  return difference(t.linear_acceleration(f), {0, 0, g});
}

Outcome turntable(const std::string& motion) {
  Trial t(motion);
  t.add_vehicle();
  const ObjectId imu = t.add_sensor("sensor.imu", "disc", at_radius);
  t.start(on_table);
  t.joint("table", keys::joint_velocity_target) = 5;
  t.run_for(0.4);
  const Outcome f = difference(t.linear_acceleration(imu), {-25 * radius, 0, g});
  const Outcome w = difference(t.angular_velocity(imu), {0, 0, 5});
  return {std::max(f.error, w.error), f.seen + ", " + w.seen};
}

/// Acceleration of 2 rad/s^2, read at a speed of 1 rad/s. The target of each step is the speed at its end.
Outcome turntable_that_speeds_up(const std::string& motion) {
  Trial t(motion);
  t.add_vehicle();
  const ObjectId imu = t.add_sensor("sensor.imu", "disc", at_radius);
  t.start(on_table);
  for (int k = 1; k <= 500; ++k) {
    t.joint("table", keys::joint_velocity_target) = 2e-3 * k;
    t.run_for(0.001);
  }
  t.run_for(0.0005);
  const double w = t.angular_velocity(imu).z();
  return difference(t.linear_acceleration(imu), {-w * w * radius, 2 * radius, g});
}

/// A circle at 2 m/s forward and 1 rad/s to the left (mecanum wheels are slower: 0.4 m/s). Motions by forces push a box
/// in this way, without weight.
Outcome driving_a_circle(const std::string& motion) {
  Trial t(motion);
  const bool pushed = t.family() == Family::forces;
  if (pushed) {
    t.world().set(world_object, keys::gravity, Vec3(0, 0, 0));
    t.add("r", test::block(2, {0.4, 0.3, 0.2}, 0.5), {{0, 0, 5}, Quat::Identity()}, {{2, 0, 0}, {0, 0, 1}});
  } else {
    t.add_vehicle();
  }
  Wrench& push = t.push(t.robot());
  const ObjectId imu = t.add_sensor("sensor.imu", t.base_name());
  t.start();
  const double speed = motion == "motion.omni" ? 0.4 : 2;
  t.command(speed, 1);
  for (int k = 0; k < 500; ++k) {
    if (pushed) push.force = t.pose(t.robot()).orientation * Vec3(0, 4, 0);
    t.run_for(0.001);
  }
  t.run_for(0.0005);
  return difference(t.linear_acceleration(imu), {0, speed, pushed ? 0 : g});
}

/// A device upside down and turned by 90 deg, on a base that turns on the spot, or on the table.
Outcome turned_gyro(const std::string& motion) {
  Trial t(motion);
  t.add_vehicle();
  const ObjectId gyro = t.add_sensor("sensor.gyro", "disc", {{"rpy", std::vector<double>{M_PI / 2, 0, 0}}});
  t.start(on_table);
  t.joint("table", keys::joint_velocity_target) = 3;
  t.run_for(0.4);
  return difference(t.angular_velocity(gyro), {0, 3, 0});
}

Outcome orientation(const std::string& motion) {
  Trial t(motion);
  t.add_vehicle({{0, 0, 3}, from_rpy(0, 0, 0.5)});
  const ObjectId imu = t.add_sensor("sensor.imu", "disc", {{"rpy", std::vector<double>{0.1, 0.2, 0.3}}});
  t.start(on_table);
  t.run_for(0.1);
  const Quat expected = from_rpy(0, 0, 0.5) * from_rpy(0.1, 0.2, 0.3);
  return difference(angle_of(expected.conjugate() * t.world().value(imu, keys::orientation)), 0);
}

/// Returns the error of a device that samples `rate` times a second at 3 m/s^2 forward.
Outcome speeding_up(const std::string& motion, double rate) {
  Trial t(motion);
  const bool pushed = t.family() == Family::forces;
  if (pushed) {
    t.world().set(world_object, keys::gravity, Vec3(0, 0, 0));
    t.add("r", test::block(2, {0.4, 0.3, 0.2}, 0.5), {{0, 0, 5}, Quat::Identity()});
  } else {
    t.add_vehicle();
  }
  Wrench& push = t.push(t.robot());
  const ObjectId f = t.add_sensor("sensor.accelerometer", t.base_name(), {}, rate);
  const double wheel = motion == "motion.ackermann" ? 0.05 : motion == "motion.omni" ? 0.0475 : 0.06;
  t.start({{"max_acceleration", 3.0}, {"max_wheel_acceleration", 3 / wheel}});
  push.force = {6, 0, 0};
  t.command(2, 0);
  t.run_for(0.3005);
  return difference(t.linear_acceleration(f), {3, 0, pushed ? 0 : g});
}
Outcome at_every_step(const std::string& motion) { return speeding_up(motion, 1000); }
Outcome at_every_fourth_step(const std::string& motion) { return speeding_up(motion, 250); }

constexpr How a = How::analytic, d = How::differenced, none = How::left_out;

}  // namespace

std::vector<Case> inertial_cases() {
  return {
      {"at rest, nose up, it feels the pull of the ground alone",
       "sensor.imu",
       "m/s^2",
       {a, a, d},
       {1e-9, 1e-9, 1e-3},
       tilted},
      {"in free fall it feels nothing", "sensor.accelerometer", "m/s^2", {none, none, d}, {0, 0, 1e-6}, falling},
      {"in free fall a spinning body feels its spin alone",
       "sensor.accelerometer",
       "m/s^2",
       {none, none, d},
       {0, 0, 1e-6},
       falling_and_spinning},
      {"the first sample in the air is nothing",
       "sensor.accelerometer",
       "m/s^2",
       {none, none, a},
       {0, 0, 0},
       first_sample_in_the_air},
      {"the first sample on the ground is g",
       "sensor.accelerometer",
       "m/s^2",
       {a, a, a},
       {1e-12, 1e-12, 1e-12},
       first_sample_on_the_ground},
      {"on a turntable it feels -w^2 r, and w", "sensor.imu", "m/s^2, rad/s", {a, a, d}, {1e-9, 1e-9, 1e-3}, turntable},
      {"on a turntable that speeds up it feels alpha r across",
       "sensor.imu",
       "m/s^2",
       {d, d, d},
       {1e-9, 1e-9, 1e-3},
       turntable_that_speeds_up},
      {"driving forward while turning left it is pushed to the left",
       "sensor.imu",
       "m/s^2",
       {a, a, d},
       {1e-9, 1e-9, 3e-3},
       driving_a_circle},
      {"a turned gyro has the turn in its own axes",
       "sensor.gyro",
       "rad/s",
       {a, a, d},
       {1e-12, 1e-12, 1e-4},
       turned_gyro},
      {"orientation is that of the device", "sensor.imu", "rad", {a, a, a}, {1e-9, 1e-9, 1e-7}, orientation},
      {"speeding up is felt as it is", "sensor.accelerometer", "m/s^2", {d, d, d}, {1e-9, 1e-9, 1e-9}, at_every_step},
      {"a sensor four times slower than the motion feels the same",
       "sensor.accelerometer",
       "m/s^2",
       {d, d, d},
       {1e-9, 1e-9, 1e-9},
       at_every_fourth_step},
  };
}

}  // namespace muro::sensor_conformance
