// SPDX-License-Identifier: MIT
// Plugins of Gazebo that drive wheels, recognised by their names and read by their parameters:
// gazebo_ros_pkgs (diff_drive, skid_steer_drive, ackermann_drive) and gz-sim (DiffDrive, AckermannSteering).
#include "plugin.hpp"

#include <algorithm>
#include <array>

#include "muro/base/limits.hpp"

namespace muro::sdf_devices {

namespace {

std::string lower_letters(const Element& e, const char* attribute) {
  const char* const text = e.Attribute(attribute);
  std::string letters;
  for (const char c : std::string_view(text ? text : ""))
    if (std::isalnum(static_cast<unsigned char>(c))) letters += char(std::tolower(static_cast<unsigned char>(c)));
  return letters;
}

/// The children of a plugin, some of which name joints of the model.
class PluginFields : public Fields {
 public:
  PluginFields(Element& plugin, std::string owner, const PartNames& parts, Messages& messages)
      : Fields(plugin, std::move(owner), messages), parts_(parts) {}

  /// Returns the joints that children with these names list, in this order.
  std::vector<std::string> joints(std::initializer_list<const char*> names) {
    std::vector<std::string> joints;
    for (const char* const name : names)
      for (const Element* e : sections(name)) {
        const std::string given = text_of(*e);
        if (const auto joint = parts_.joint(given))
          joints.push_back(*joint);
        else if (unknown_.empty())
          unknown_ = given;
      }
    return joints;
  }
  /// First listed name that is not a moving joint; empty if all are moving joints.
  const std::string& unknown() const { return unknown_; }

 private:
  const PartNames& parts_;
  std::string unknown_;
};

std::optional<double> length(Fields& fields, std::initializer_list<const char*> names) {
  std::optional<double> found;
  for (const char* const name : names)
    if (const auto value = fields.number(name, limits::min_size, 1000); value && !found) found = value;
  return found;
}

void add_wheel_radius(Subsystem& drive, Fields& fields) {
  const auto radius = length(fields, {"wheel_radius", "wheelRadius"});
  const auto diameter = length(fields, {"wheel_diameter", "wheelDiameter"});
  if (radius)
    drive.add("wheel_radius", *radius);
  else if (diameter)
    drive.add("wheel_radius", *diameter / 2);
}

bool add_joints(Subsystem& drive, PluginFields& fields, std::string_view key,
                std::initializer_list<const char*> names) {
  const std::vector<std::string> joints = fields.joints(names);
  if (!joints.empty()) drive.add(key, joints);
  return !joints.empty();
}

std::optional<Subsystem> side_drive(PluginFields& fields, bool is_skid_steer, const FileLocation& at) {
  const auto left = fields.joints({"left_joint", "leftJoint", "leftFrontJoint", "leftRearJoint"});
  const auto right = fields.joints({"right_joint", "rightJoint", "rightFrontJoint", "rightRearJoint"});
  if (left.empty() || right.empty()) return std::nullopt;
  const bool several = is_skid_steer || left.size() > 1 || right.size() > 1;
  Subsystem drive("drive", several ? "drive.skid_steer" : "drive.differential", at);
  drive.add("left", left);
  drive.add("right", right);
  add_wheel_radius(drive, fields);
  if (const auto track = length(fields, {"wheel_separation", "wheelSeparation"})) drive.add("track", *track);
  return drive;
}

std::optional<Subsystem> ackermann(PluginFields& fields, const FileLocation& at) {
  Subsystem drive("drive", "drive.ackermann", at);
  if (!add_joints(drive, fields, "steering", {"left_steering_joint", "right_steering_joint"})) return std::nullopt;
  // gz-sim drives all named wheels, gazebo_ros_pkgs only the rear wheels
  if (!add_joints(drive, fields, "driven", {"left_joint", "right_joint"}))
    add_joints(drive, fields, "driven", {"rear_left_joint", "rear_right_joint"});
  add_wheel_radius(drive, fields);
  for (const char* const name : {"steering_limit", "max_steer"})
    if (const auto angle = fields.number(name, 1e-6, 1e9)) {
      drive.add("max_steering_angle", *angle);
      break;
    }
  return drive;
}

bool names_any(std::string_view file, std::initializer_list<std::string_view> parts) {
  return std::any_of(parts.begin(), parts.end(), [&](std::string_view p) { return file.find(p) != file.npos; });
}

}  // namespace

Device read_plugin(Element& plugin, PartNames& parts, Messages& messages) {
  const char* const file_name = plugin.Attribute("filename");
  const FileLocation at = messages.at(plugin);
  // classic plugins are recognised by their file name, those of gz-sim by their class name
  const std::string known_by = lower_letters(plugin, "filename") + " " + lower_letters(plugin, "name");
  PluginFields fields(plugin, concat("plugin ", quote(file_name ? file_name : "")), parts, messages);
  Device device{fields.owner(), at, {}};
  std::optional<Subsystem> drive;
  if (names_any(known_by, {"skidsteer"}))
    drive = side_drive(fields, true, at);
  else if (names_any(known_by, {"diffdrive", "differentialdrive"}))
    drive = side_drive(fields, false, at);
  else if (names_any(known_by, {"ackermann"}))
    drive = ackermann(fields, at);
  if (!fields.unknown().empty()) {
    messages.problems.warning(at, concat(fields.owner(), " is left out: it names ", quote(fields.unknown()),
                                         ", which is no joint that moves"));
    return device;
  }
  if (!drive) {
    messages.left_out.add(Severity::warning, concat("<plugin filename=", quote(file_name ? file_name : ""), ">"),
                          "plugins of Gazebo are not run; a scenario names algorithms and controllers", at);
    return device;
  }
  for (const Element* e = plugin.FirstChildElement(); e; e = e->NextSiblingElement())
    if (const std::string name = concat("<", e->Name(), ">");
        !fields.is_read(*e) && device.unused.find(name) == device.unused.npos)
      device.unused += concat(device.unused.empty() ? "" : ", ", name);
  device.subsystems.push_back(std::move(*drive));
  return device;
}

}  // namespace muro::sdf_devices
