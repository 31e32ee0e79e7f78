// SPDX-License-Identifier: MIT
// Encoders and odometry.
#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/sensor/case.hpp"

namespace muro::sensor_conformance {

namespace {

const Trial::Parameters on_table{{"base", "fixed"}, {"joints", "velocity"}, {"max_joint_acceleration", 1e9}};

/// A ramp of 0.3 rad/s through 391 steps of 12 bits: the error is uniform over one step.
Outcome quantised(const std::string& motion) {
  Trial t(motion);
  t.add_vehicle();
  const ObjectId s = t.add_sensor("sensor.encoder", "table", {{"counts", 4096.0}});
  t.start(on_table);
  t.joint("table", keys::joint_velocity_target) = 0.3;
  t.run_for(0.0005);
  double sum = 0;
  const int readings = 2000;
  for (int k = 0; k < readings; ++k) {
    t.run_for(0.0005);  // the joint is where the sensor has read it
    const double truth = t.joint("table", keys::joint_position);
    t.run_for(0.0005);
    const double error = t.world().value(s, keys::encoder_position) - truth;
    const double steps = t.world().value(s, keys::encoder_position) / (2 * M_PI / 4096);
    if (std::abs(steps - std::round(steps)) > 1e-9) return {1, "no multiple of a step"};
    sum += error * error;
  }
  return difference(std::sqrt(sum / readings) / (2 * M_PI / 4096 / std::sqrt(12.0)), 1);
}

/// Speed of 1 rad/s; a joint moves less than a step of 1.534 mrad in 1 ms. Most readings are 0, others 1.534 rad/s.
Outcome counted_velocity(const std::string& motion) {
  Trial t(motion);
  t.add_vehicle();
  const ObjectId s = t.add_sensor("sensor.encoder", "table", {{"counts", 4096.0}});
  t.start(on_table);
  t.joint("table", keys::joint_velocity_target) = 1;
  t.run_for(0.2005);
  double sum = 0;
  for (int k = 0; k < 1000; ++k) {
    t.run_for(0.001);
    const double v = t.world().value(s, keys::encoder_velocity), step = 2 * M_PI / 4096 / 1e-3;
    if (std::abs(v) > 1e-9 && std::abs(v - step) > 1e-9) return {1, "neither 0 nor one step"};
    sum += v;
  }
  return difference(sum / 1000, 1);
}

/// A straight line of 10 m. Odometry takes the left wheels to be 1 % too large on a track of 0.3 m.
Outcome wrong_radius(const std::string& motion) {
  Trial t(motion);
  t.add_vehicle();
  const ObjectId s = t.add_sensor("sensor.odometry", "base_link",
                                  {{"track", 0.3}, {"radius_error", std::vector<double>{0.01, 0}}}, 100);
  t.start();
  t.command(0.4, 0);
  t.run_for(25.0005);
  const Pose pose = t.world().value(s, keys::odometry_pose);
  return difference(Vec3(pose.position.x(), pose.position.y(), yaw_of(pose.orientation)),
                    {9.86492, -1.65955, -1.0 / 3});
}

/// Half a turn on the spot. Odometry takes the track to be 2 % too large.
Outcome wrong_track(const std::string& motion) {
  Trial t(motion);
  t.add_vehicle();
  const ObjectId s = t.add_sensor("sensor.odometry", "base_link", {{"track_error", 0.02}}, 100);
  t.start();
  t.command(0, 0.5);
  t.run_for(4.0005);
  const double seen = yaw_of(t.world().value(s, keys::odometry_pose).orientation);
  return difference(yaw_of(t.pose(t.robot()).orientation) - 0.5e-3 - seen, 2 * 0.02 / 1.02);
}

/// An arc, compared with the true pose at the same instant, in the frame of its start.
Outcome arcs(const std::string& motion) {
  Trial t(motion);
  const Pose start{{1, 2, 0.1}, from_rpy(0, 0, 0.7)};
  t.add_vehicle(start);
  const std::string drive = motion == "motion.omni" ? "omni" : "differential";
  const ObjectId s = t.add_sensor("sensor.odometry", "base_link", {{"drive", drive}}, 50);
  const ObjectId truth = t.add_sensor("sensor.truth", "base_link", {}, 50);
  t.start();
  t.command(0.3, 0.5);
  t.run_for(4.0005);
  const Pose seen = t.world().value(s, keys::odometry_pose);
  const Pose expected = start.inverse() * t.world().value(truth, keys::true_pose);
  return difference(seen.position, expected.position);
}

constexpr How a = How::analytic, none = How::left_out;

}  // namespace

std::vector<Case> joint_cases() {
  return {
      {"12 bits are wrong by a step over the root of 12",
       "sensor.encoder",
       "relative",
       {a, a, a},
       {0.02, 0.02, 0.02},
       quantised},
      {"a counted velocity is whole steps, and right in the mean",
       "sensor.encoder",
       "rad/s",
       {a, a, a},
       {2e-3, 2e-3, 2e-3},
       counted_velocity},
      {"a left radius 1 % too large bends 10 m to the right",
       "sensor.odometry",
       "m, rad",
       {none, a, none},
       {0, 1e-5, 0},
       wrong_radius},
      {"a track 2 % too large turns by A e / (1 + e) too little",
       "sensor.odometry",
       "rad",
       {none, a, none},
       {0, 1e-9, 0},
       wrong_track,
       "motion.differential_drive"},
      {"odometry without errors follows arcs",
       "sensor.odometry",
       "m",
       {none, a, none},
       {0, 1e-9, 0},
       arcs,
       "motion.differential_drive"},
      {"odometry of mecanum wheels follows arcs",
       "sensor.odometry",
       "m",
       {none, a, none},
       {0, 1e-9, 0},
       arcs,
       "motion.omni"},
  };
}

}  // namespace muro::sensor_conformance
