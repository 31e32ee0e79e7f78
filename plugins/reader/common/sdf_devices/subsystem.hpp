// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <set>
#include <string>
#include <string_view>
#include <vector>

#include "plugins/common/model_file/problems.hpp"

namespace muro::sdf_devices {

/// One subsystem of a robot, as a scenario writes it: `lidar: {use: laser.embree, on: base_link, rate: 10}`.
class Subsystem {
 public:
  /// `use`: name of the algorithm; empty if this sets parameters of a subsystem that the scenario names.
  Subsystem(std::string name, std::string_view use, model_file::FileLocation location);

  /// Sets the part of the robot, or the sensor, to which the subsystem belongs.
  void mount_on(std::string part) { on_ = std::move(part); }
  void rename(std::string name) { name_ = std::move(name); }
  const std::string& mounted_on() const { return on_; }
  void add(std::string_view key, double value);
  void add(std::string_view key, const std::vector<double>& values);
  void add(std::string_view key, std::string_view value);
  void add_flag(std::string_view key, bool value) { add_raw(key, value ? "true" : "false"); }
  void add(std::string_view key, const std::vector<std::string>& values);

  const std::string& name() const { return name_; }
  const model_file::FileLocation& location() const { return location_; }
  std::string text() const;

 private:
  void add_raw(std::string_view key, std::string_view value);

  std::string name_, use_, on_;
  std::string body_;  ///< other entries between the braces
  model_file::FileLocation location_;
};

/// The names in use in a robot, and the robot's names of the joints of the file.
struct PartNames {
  /// Names of links, joints and subsystems, and other keys of a robot in a scenario.
  std::set<std::string> used = {
      "angular_velocity", "at",    "color",  "count", "drive",       "dynamics", "friction", "joints",   "mass",
      "materials",        "model", "motion", "place", "restitution", "shape",    "texture",  "variants", "velocity"};
  /// Returns the robot's name of a joint of the file; nothing if no joint of this name moves.
  std::function<std::optional<std::string>(const std::string&)> joint = {};

  /// Returns `wanted`, followed by `_sensor` as often as needed to be unique.
  std::string unique(std::string wanted) {
    while (!used.insert(wanted).second) wanted += "_sensor";
    return wanted;
  }
};

/// The subsystems that are made of one <sensor> or <plugin> of a file.
struct Device {
  std::string owner;                  ///< name in messages: "sensor `lidar`"
  model_file::FileLocation location;  ///< location of its element
  std::vector<Subsystem> subsystems;  ///< empty if muro has no counterpart
  std::string unused = {};            ///< elements of a plugin that change nothing

  /// Mounts it on a part of a robot that consists of several models. Names get the prefix `prefix` ("arm.").
  void place(const std::string& prefix, const std::string& part, PartNames& names);
  /// Reports the subsystems as a note.
  void tell(model_file::Problems& problems) const;
};

/// Gives the subsystems of a model to the base of its robot, which must be the last part of the builder.
void give(const std::vector<Subsystem>& subsystems, RobotBuilder& builder);

}  // namespace muro::sdf_devices
