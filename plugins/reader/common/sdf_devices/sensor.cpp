// SPDX-License-Identifier: MIT
#include "sensor.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string_view>

#include "muro/base/elementary.hpp"
#include "muro/base/limits.hpp"
#include "muro/base/printable.hpp"
#include "muro/toolkit/rotations.hpp"

namespace muro::sdf_devices {

namespace {

struct Kind {
  std::string_view type;
  Subsystems (*read)(SensorReading&);
};

/// Sensor types of SDFormat 1.2 to 1.9.
constexpr std::array<Kind, 19> kinds{{{"ray", read_lidar},
                                      {"gpu_ray", read_lidar},
                                      {"lidar", read_lidar},
                                      {"gpu_lidar", read_lidar},
                                      {"camera", read_cameras},
                                      {"multicamera", read_cameras},
                                      {"depth", read_cameras},
                                      {"depth_camera", read_cameras},
                                      {"rgbd", read_cameras},
                                      {"rgbd_camera", read_cameras},
                                      {"segmentation", read_cameras},
                                      {"segmentation_camera", read_cameras},
                                      {"imu", read_imu},
                                      {"magnetometer", read_magnetometer},
                                      {"gps", read_gps},
                                      {"navsat", read_gps},
                                      {"contact", read_contact},
                                      {"force_torque", read_force_torque},
                                      {"force torque", read_force_torque}}};

std::string attribute_of(const Element& e, const char* name) {
  const char* const text = e.Attribute(name);
  return text ? text : "";
}

/// Returns fixed-axis roll, pitch, yaw (rad) of a rotation; roll is 0 if pitch is a right angle.
Vec3 rpy_of(const Quat& q) {
  const Mat3 r = q.toRotationMatrix();
  const double level = std::sqrt(r(0, 0) * r(0, 0) + r(1, 0) * r(1, 0));
  const double pitch = elementary::atan2(-r(2, 0), level);
  if (level < 1e-9) return {0, pitch, elementary::atan2(-r(0, 1), r(1, 1))};
  return {elementary::atan2(r(2, 1), r(2, 2)), pitch, elementary::atan2(r(1, 0), r(0, 0))};
}

/// Makes a valid name of a subsystem.
std::string subsystem_name(std::string name) {
  for (char& c : name)
    if (c == '/' || c == ':' || static_cast<unsigned char>(c) <= ' ') c = '_';
  constexpr std::size_t longest = 150;
  return printable(name.substr(0, longest));
}

}  // namespace

std::optional<DevicePose> take_pose(Fields& fields) {
  Element* const e = fields.section("pose");
  if (!e || text_of(*e).empty()) return DevicePose{};
  for (const char* const frame : {"relative_to", "frame"})
    if (!attribute_of(*e, frame).empty()) {
      fields.messages().problems.warning(
          fields.messages().at(*e), concat(fields.owner(), " is left out: its pose is in the frame ",
                                           quote(attribute_of(*e, frame)), ", and only poses in the link are read"));
      return std::nullopt;
    }
  const bool quaternion = attribute_of(*e, "rotation_format") == "quat_xyzw";
  const bool degrees = attribute_of(*e, "degrees") == "true" || attribute_of(*e, "degrees") == "1";
  const auto v = fields.numbers("pose", quaternion ? 7 : 6, -limits::position, limits::position);
  if (!v) return DevicePose{};
  const Vec3 position((*v)[0], (*v)[1], (*v)[2]);
  if (quaternion) {
    const Quat given((*v)[6], (*v)[3], (*v)[4], (*v)[5]);
    const Quat q = given.norm() > 1e-9 ? given.normalized() : Quat::Identity();
    return DevicePose{{position, q}, rpy_of(q)};
  }
  const Vec3 rpy = (degrees ? M_PI / 180 : 1.0) * Vec3((*v)[3], (*v)[4], (*v)[5]);
  return DevicePose{{position, from_rpy(rpy.x(), rpy.y(), rpy.z())}, rpy};
}

DevicePose DevicePose::operator*(const DevicePose& within) const {
  const Pose both = pose * within.pose;
  if (within.pose.orientation.vec().isZero(0)) return {both, rpy};
  return {both, rpy_of(both.orientation)};
}

Subsystem SensorReading::begin(const std::string& called, std::string_view use, const DevicePose& within) const {
  Subsystem made(called, use, location);
  made.mount_on(mounted_on);
  if (rate)
    made.add("rate", *rate);
  else
    made.add("rate", "on_demand");
  // a bumper covers its link; force_torque measures in the axes of its link (forcetorque.sdf, frame `child`)
  if (use == "sensor.bumper" || use == "sensor.force_torque") return made;
  const DevicePose origin = pose * within;
  const Vec3 &p = origin.pose.position, &turn = origin.rpy;
  if (!p.isZero(0)) made.add("offset", std::vector<double>{p.x(), p.y(), p.z()});
  if (!turn.isZero(0) && use != "sensor.gps") made.add("rpy", std::vector<double>{turn.x(), turn.y(), turn.z()});
  return made;
}

Device read_sensor(Element& sensor, const std::string& mounted_on, Messages& messages) {
  const std::string type = attribute_of(sensor, "type");
  const std::string name = attribute_of(sensor, "name");
  Fields fields(sensor, concat("sensor ", quote(name.empty() ? type : name)), messages);
  Device device{fields.owner(), messages.at(sensor), {}};
  const auto* const kind = std::find_if(kinds.begin(), kinds.end(), [&](const Kind& k) { return k.type == type; });
  if (kind == kinds.end()) {
    messages.left_out.add(Severity::warning, concat("<sensor type=", quote(type), ">"),
                          "there is no such sensor; `muro plugins list` shows those that a scenario can have",
                          messages.at(sensor));
    return device;
  }
  const auto pose = take_pose(fields);
  if (!pose) return device;
  SensorReading reading{
      fields, type, subsystem_name(name.empty() ? type : name), mounted_on, *pose, std::nullopt, messages.at(sensor)};
  if (const auto rate = fields.number("update_rate", 0, 1e4); rate && *rate >= 1e-6) reading.rate = rate;
  device.subsystems = kind->read(reading);
  fields.skip({"always_on", "enable_metrics", "frame_id", "gz_frame_id", "ignition_frame_id", "topic", "visualize"},
              "a scenario says who runs, shows and sends readings");
  for (const Element* plugin : fields.sections("plugin"))
    messages.left_out.add(
        Severity::note, concat("<plugin filename=", quote(attribute_of(*plugin, "filename")), "> of a sensor"),
        "readings are properties, which streams and recorders of the scenario send and write", messages.at(*plugin));
  fields.list_unread("the sensor has no counterpart of it");
  return device;
}

}  // namespace muro::sdf_devices
