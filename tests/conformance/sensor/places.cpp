// SPDX-License-Identifier: MIT
// Place of the robot: satellite navigation, the field of the earth, the truth. Read at the start, before it moves.
#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/sensor/case.hpp"

namespace muro::sensor_conformance {

namespace {

/// Example of GeographicLib's CartConvert: 33.3 deg north, 44.4 deg east, 6000 m high, from 33, 44, 20.
Outcome on_the_earth(const std::string& motion) {
  Trial t(motion);
  t.add_vehicle({{37288.97, 33374.29, 5783.64 - 0.5}, Quat::Identity()});
  const ObjectId s =
      t.add_sensor("sensor.gps", "base_link",
                   {{"reference", std::vector<double>{33, 44, 20}}, {"offset", std::vector<double>{0, 0, 0.5}}}, 5);
  t.start();
  t.run_for(0.0005);
  const double metres = 111e3;  // in a degree, about
  return difference(Vec3(metres * t.world().value(s, keys::latitude), metres * t.world().value(s, keys::longitude),
                         t.world().value(s, keys::altitude)),
                    {metres * 33.3, metres * 44.4, 6000});
}

/// x of the world points north: 1 m/s forward is 1 m/s north.
Outcome velocity(const std::string& motion) {
  Trial t(motion);
  t.world().set(world_object, keys::gravity, Vec3(0, 0, 0));
  t.add_vehicle({{0, 0, 3}, Quat::Identity()}, {{0.3, 0, 0}, Vec3::Zero()});
  const ObjectId s = t.add_sensor("sensor.gps", "base_link", {{"heading", M_PI / 2}}, 10);
  t.start();
  t.command(0.3, 0);
  t.run_for(0.1005);
  return difference(t.world().value(s, keys::gps_velocity), {0, 0.3, 0});
}

Outcome field(const std::string& motion) {
  Trial t(motion);
  const Quat body = from_rpy(0, 0, 0.5), device = from_rpy(0.1, 0.2, 0.3);
  t.add_vehicle({{0, 0, 3}, body});
  const ObjectId s =
      t.add_sensor("sensor.magnetometer", "base_link",
                   {{"rpy", std::vector<double>{0.1, 0.2, 0.3}}, {"field", std::vector<double>{0, 2e-5, -4e-5}}}, 100);
  t.start();
  t.run_for(0.0005);
  return difference(t.world().value(s, keys::magnetic_field), (body * device).conjugate() * Vec3(0, 2e-5, -4e-5));
}

/// Checks a block 2 m in front of the robot and 1 m to the side, in the frame of the device.
Outcome seen_from_the_device(const std::string& motion) {
  Trial t(motion);
  const Pose start{{1, 2, 3}, from_rpy(0, 0, 0.5)};
  const Shape box = Shape::box({1, 1, 1});
  t.world().add_scenery("goal", start * Pose{{2, 1, 0}, Quat::Identity()}, std::span<const Shape>(&box, 1));
  t.add_vehicle(start);
  const ObjectId s = t.add_sensor("sensor.truth", "base_link", {{"of", "goal"}, {"frame", "self"}}, 100);
  t.start();
  t.run_for(0.0005);
  return difference(t.world().value(s, keys::true_pose).position, {2, 1, 0});
}

constexpr How a = How::analytic;

}  // namespace

std::vector<Case> place_cases() {
  return {
      {"latitude, longitude and altitude are those of GeographicLib",
       "sensor.gps",
       "m",
       {a, a, a},
       {0.01, 0.01, 0.01},
       on_the_earth},
      {"velocity is told to the east and north", "sensor.gps", "m/s", {a, a, a}, {1e-9, 1e-9, 1e-9}, velocity},
      {"the field of the earth is told in the axes of the device",
       "sensor.magnetometer",
       "T",
       {a, a, a},
       {1e-15, 1e-15, 1e-15},
       field},
      {"the truth of scenery is told in the frame of the device",
       "sensor.truth",
       "m",
       {a, a, a},
       {1e-9, 1e-9, 1e-9},
       seen_from_the_device},
  };
}

}  // namespace muro::sensor_conformance
