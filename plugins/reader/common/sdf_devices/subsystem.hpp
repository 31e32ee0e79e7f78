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
  /// `use`: the algorithm; empty for parameters of what the scenario names.
  Subsystem(std::string name, std::string_view use, model_file::FileLocation location);

  /// The part of the robot, or the sensor, that it belongs to.
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
  std::string body_;  ///< what else stands between the braces
  model_file::FileLocation location_;
};

/// The names of a robot's parts, and what devices call them.
struct PartNames {
  /// By links, joints and subsystems; and by what else a robot has in a scenario.
  std::set<std::string> used = {
      "angular_velocity", "at",    "color",  "count", "drive",       "dynamics", "friction", "joints",   "mass",
      "materials",        "model", "motion", "place", "restitution", "shape",    "texture",  "variants", "velocity"};
  /// What the robot calls a joint of the file that moves; nothing where there is none.
  std::function<std::optional<std::string>(const std::string&)> joint = {};

  /// `wanted`, with `_sensor` behind it as often as it takes to be new.
  std::string unique(std::string wanted) {
    while (!used.insert(wanted).second) wanted += "_sensor";
    return wanted;
  }
};

/// What one <sensor> or <plugin> of a file becomes.
struct Device {
  std::string owner;                  ///< in messages: "sensor `lidar`"
  model_file::FileLocation location;  ///< of its element
  std::vector<Subsystem> subsystems;  ///< none where muro has nothing like it
  std::string unused = {};            ///< elements of a plugin that change nothing

  /// On a part of a robot that consists of several models, with `prefix` ("arm.") before its names.
  void place(const std::string& prefix, const std::string& part, PartNames& names);
  /// Tells what it has become.
  void tell(model_file::Problems& problems) const;
};

/// Gives them to the base of a robot, the last part of the builder, as what its model brings.
void give(const std::vector<Subsystem>& subsystems, RobotBuilder& builder);

}  // namespace muro::sdf_devices
