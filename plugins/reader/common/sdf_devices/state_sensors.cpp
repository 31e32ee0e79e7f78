// SPDX-License-Identifier: MIT
// Sensors of the robot's own state: imu, magnetometer, gps, contact, force_torque.
#include <tuple>

#include "noise.hpp"
#include "sensor.hpp"

namespace muro::sdf_devices {

namespace {

/// Reads the noise of each axis: <x><noise>...
std::vector<Noise> noise_of_axes(Element& parent, const std::string& owner, Messages& messages) {
  std::vector<Noise> noise(3);
  Fields axes(parent, owner, messages);
  constexpr const char* of_axis[] = {"x", "y", "z"};
  for (std::size_t i = 0; i < 3; ++i)
    if (Element* const axis = axes.section(of_axis[i])) {
      Fields given(*axis, owner, messages);
      noise[i] = take_noise(given);
      given.list_unread("SDFormat has no such element there");
    }
  axes.list_unread("SDFormat has no such element there");
  return noise;
}

/// Reads the noise that SDFormat 1.4 states once for all axes: <noise><rate> and <accel>.
void take_old_noise(Fields& imu, std::vector<Noise>& rates, std::vector<Noise>& accelerations) {
  Element* const e = imu.section("noise");
  if (!e) return;
  Fields noise(*e, imu.owner() + ", <noise>", imu.messages());
  noise.text("type");
  for (auto [name, axes] : {std::pair("rate", &rates), std::pair("accel", &accelerations)})
    if (Element* const given = noise.section(name)) {
      Fields fields(*given, noise.owner(), imu.messages());
      axes->assign(3, gaussian_noise(fields));
    }
  noise.list_unread("SDFormat has no such element there");
}

void append(Subsystems& all, std::vector<Subsystem> more) {
  for (Subsystem& s : more) all.push_back(std::move(s));
}

}  // namespace

Subsystems read_imu(SensorReading& s) {
  const Subsystem made = s.begin(s.name, "sensor.imu");
  Subsystems all{made};
  std::vector<Noise> rates(3), accelerations(3);
  if (Element* const e = s.fields.section("imu")) {
    Fields imu(*e, s.fields.owner(), s.fields.messages());
    take_old_noise(imu, rates, accelerations);
    for (auto [name, noise] : {std::pair("angular_velocity", &rates), std::pair("linear_acceleration", &accelerations)})
      if (Element* const axes = imu.section(name))
        *noise = noise_of_axes(*axes, imu.owner() + ", <" + name + ">", imu.messages());
    imu.skip({"orientation_reference_frame", "enable_orientation", "topic"},
             "orientation is that of the device in the world");
    imu.list_unread("the sensor has no counterpart of it");
  }
  append(all, error_of(made, "_gyro_error", "angular_velocity", rates));
  append(all, error_of(made, "_accelerometer_error", "linear_acceleration", accelerations));
  return all;
}

Subsystems read_magnetometer(SensorReading& s) {
  const Subsystem made = s.begin(s.name, "sensor.magnetometer");
  Subsystems all{made};
  if (Element* const e = s.fields.section("magnetometer")) {
    append(all, error_of(made, "_error", "magnetic_field", noise_of_axes(*e, s.fields.owner(), s.fields.messages())));
  }
  return all;
}

Subsystems read_gps(SensorReading& s) {
  const Subsystem made = s.begin(s.name, "sensor.gps");
  Subsystems all{made};
  for (const char* const kind : {"gps", "navsat"}) {
    Element* const e = s.fields.section(kind);
    if (!e) continue;
    Fields gps(*e, s.fields.owner(), s.fields.messages());
    for (auto [name, suffix, property] : {std::tuple("position_sensing", "_position_error", "gps.position"),
                                          std::tuple("velocity_sensing", "_velocity_error", "gps.velocity")}) {
      Element* const sensing = gps.section(name);
      if (!sensing) continue;
      Fields fields(*sensing, gps.owner() + ", <" + name + ">", gps.messages());
      Noise of[2];
      const char* const directions[] = {"horizontal", "vertical"};
      for (int i = 0; i < 2; ++i)
        if (Element* const direction = fields.section(directions[i])) {
          Fields given(*direction, fields.owner(), gps.messages());
          of[i] = take_noise(given);
          given.list_unread("SDFormat has no such element there");
        }
      fields.list_unread("SDFormat has no such element there");
      append(all, error_of(made, suffix, property, {of[0], of[0], of[1]}));
    }
    gps.list_unread("the sensor has no counterpart of it");
  }
  return all;
}

Subsystems read_contact(SensorReading& s) {
  Subsystem made = s.begin(s.name, "sensor.bumper");
  if (Element* const e = s.fields.section("contact")) {
    Fields contact(*e, s.fields.owner(), s.fields.messages());
    contact.skip({"collision", "topic"}, "a bumper is all of its link");
    contact.list_unread("the sensor has no counterpart of it");
  }
  return {made};
}

Subsystems read_force_torque(SensorReading& s) {
  if (Element* const e = s.fields.section("force_torque")) {
    Fields fields(*e, s.fields.owner(), s.fields.messages());
    const std::string frame = fields.text("frame"), direction = fields.text("measure_direction");
    if (frame == "parent" || direction == "parent_to_child") {
      s.fields.messages().problems.warning(
          s.location, concat(s.fields.owner(), " is left out: a wrench is that of the child on its parent, in the ",
                             "axes of the child"));
      return {};
    }
    fields.skip({"force", "torque"}, "a `sensor.error` of the scenario can change the wrench");
    fields.list_unread("the sensor has no counterpart of it");
  }
  return {s.begin(s.name, "sensor.force_torque")};
}

}  // namespace muro::sdf_devices
