// SPDX-License-Identifier: MIT
// Events between steps leave no trace in readings: resets, snapshots, hand-overs, robots that are placed elsewhere.
#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/sensor/case.hpp"

namespace muro::sensor_conformance {

namespace {

/// Accelerations and angular velocities of 20 readings, compared with those of another run.
struct Readings {
  std::vector<Vec3> all;
  void take(Trial& t, ObjectId sensor) {
    for (int k = 0; k < 20; ++k) {
      t.run_for(0.001);
      all.push_back(t.linear_acceleration(sensor));
      all.push_back(t.angular_velocity(sensor));
    }
  }
  Outcome against(const Readings& other) const {
    Outcome worst{0, "all alike"};
    for (std::size_t i = 0; i < all.size(); ++i)
      if (const Outcome o = difference(all[i], other.all[i]); o.error > worst.error) worst = o;
    return worst;
  }
};

ObjectId moving(Trial& t) {
  t.add_vehicle({{0, 0, 4}, Quat::Identity()}, {{0.5, 0, 0}, {0, 0, 0.2}});
  const ObjectId imu = t.add_sensor("sensor.imu", "disc", {{"offset", std::vector<double>{0.2, 0, 0}}});
  t.start();
  t.command(0.5, 0.3);
  return imu;
}

Outcome reset(const std::string& motion) {
  Trial t(motion);
  const ObjectId imu = moving(t);
  Readings first, second;
  first.take(t, imu);
  t.run_for(0.1);
  t.reset();
  t.command(0.5, 0.3);
  second.take(t, imu);
  return second.against(first);
}

Outcome snapshot(const std::string& motion) {
  Trial t(motion);
  const ObjectId imu = moving(t);
  t.run_for(0.05);
  const Snapshot kept = t.snapshot();
  Readings first, second;
  first.take(t, imu);
  t.restore(kept);
  second.take(t, imu);
  return second.against(first);
}

/// Checks a robot that is placed elsewhere with another speed. Its readings must be those of a robot that has always
/// moved so.
Outcome put_elsewhere(const std::string& motion) {
  Trial t(motion);
  t.world().set(world_object, keys::gravity, Vec3(0, 0, 0));
  t.add("r", test::block(2, {0.4, 0.3, 0.2}, 0.5), {{0, 0, 4}, Quat::Identity()}, {{1, 0, 0}, {0, 0, 0}});
  const ObjectId f = t.add_sensor("sensor.accelerometer", t.base_name());
  t.start();
  t.command(1, 0);
  t.run_for(0.1);
  Placement p;
  p.object = t.robot().base();
  p.pose = {{3, 2, 4}, from_rpy(0, 0, 1)};
  p.twist = {p.pose.orientation * Vec3(7, 0, 0), Vec3::Zero()};
  t.place(p);
  t.command(7, 0);
  t.run_for(0.0015);
  return difference(t.linear_acceleration(f), Vec3::Zero());
}

/// Checks a hand-over to another motion and back at a constant speed without weight: readings are 0.
Outcome handed_over(const std::string& motion) {
  const std::string other = motion == "motion.simplified" ? "motion.point" : "motion.simplified";
  test::Scene t;
  t.world().set(world_object, keys::gravity, Vec3(0, 0, 0));
  const RobotView& r =
      t.add("r", test::block(2, {0.4, 0.3, 0.2}, 0.5), {{0, 0, 4}, Quat::Identity()}, {{1, 0, 0}, Vec3::Zero()});
  t.set_levels(r, {"own", "other"}, 0);
  t.use(motion, 1000, {{&r, r.base(), 0}});
  t.use(other, 1000, {{&r, r.base(), 1}});
  t.use_contacts();
  const ObjectId sensor = t.add_sensor_object(r, "sensor", r.base());
  t.use("sensor.accelerometer", 1000, {{&r, sensor}});
  t.build();
  if (motion == "motion.point" || other == "motion.point")
    t.world().value(r.base(), keys::command_twist) = {{1, 0, 0}, Vec3::Zero()};
  double worst = 0;
  for (int k = 0; k < 60; ++k) {
    t.world().value(r.base(), keys::motion_level_target) = k / 15 % 2;
    t.run_for(0.001);
    worst = std::max(worst, t.world().value(sensor, keys::linear_acceleration).norm());
  }
  return difference(worst, 0);
}

/// Returns the pose of a robot that falls on the ground with all sensors of its motion, at rates that divide its own.
Pose after_a_second(const std::string& motion, bool senses) {
  Trial t(motion);
  t.add_ground();
  t.add_vehicle({{0, 0, 0.15}, from_rpy(0.1, 0, 0)});
  if (senses) {
    t.add_sensor("sensor.imu", "disc", {}, 200);
    t.add_sensor("sensor.encoder", "table", {{"counts", 4096.0}}, 1000);
    t.add_sensor("sensor.gps", "base_link", {}, 5);
    t.add_sensor("sensor.magnetometer", "base_link", {}, 50);
    t.add_sensor("sensor.truth", "disc", {{"acceleration", true}, {"frame", "base_link"}}, 20);
    if (t.family() == Family::wheeled) t.add_sensor("sensor.odometry", "base_link", {}, 50);
    if (t.family() == Family::forces) t.add_sensor("sensor.foot", "base_link", {}, 40);
    if (t.family() == Family::forces) t.add_sensor("sensor.bumper", "base_link", {}, 100);
    if (t.family() == Family::forces) t.add_sensor("sensor.force_torque", "disc", {}, 125);
  }
  t.start();
  if (senses) t.verify_access();  // checks that they read and write only what they have declared
  t.command(0.3, 0.2);
  t.run_for(1);
  return t.pose(t.robot());
}

Outcome only_looking(const std::string& motion) {
  const Pose seen = after_a_second(motion, true), expected = after_a_second(motion, false);
  const Outcome turned = difference(seen.orientation.vec(), expected.orientation.vec());
  return turned.error > 0 ? turned : difference(seen.position, expected.position);
}

constexpr How a = How::analytic, none = How::left_out;

}  // namespace

std::vector<Case> change_cases() {
  return {
      {"after a reset all readings are those of the first run", "sensor.imu", "as read", {a, a, a}, {0, 0, 0}, reset},
      {"after a snapshot all readings are those that came then",
       "sensor.imu",
       "as read",
       {a, a, a},
       {0, 0, 0},
       snapshot},
      {"a robot with sensors moves as it would without, to the bit", "all", "m, 1", {a, a, a}, {0, 0, 0}, only_looking},
      {"a robot that is put elsewhere feels nothing of it",
       "sensor.accelerometer",
       "m/s^2",
       {a, none, a},
       {1e-9, 0, 1e-9},
       put_elsewhere},
      {"a hand-over between motions is not felt",
       "sensor.accelerometer",
       "m/s^2",
       {a, none, a},
       {1e-9, 0, 1e-9},
       handed_over},
  };
}

}  // namespace muro::sensor_conformance
