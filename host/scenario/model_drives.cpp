// SPDX-License-Identifier: MIT
#include "host/scenario/model_drives.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cstring>
#include <memory>
#include <optional>

#include "muro/toolkit/joint_drives.hpp"
#include "muro/vocabulary.hpp"

namespace muro::host {

namespace {

/// Parameters of motions with position drives: two lists of "joint=gain", and a number.
constexpr std::string_view stiffness = "stiffness", damping = "damping", natural_frequency = "natural_frequency";

constexpr std::pair<const Parameter*, DriveMode> lists[] = {{&velocity_joints, DriveMode::velocity},
                                                            {&position_joints, DriveMode::position},
                                                            {&effort_joints, DriveMode::effort},
                                                            {&passive_joints, DriveMode::passive}};

std::vector<std::string> list_in(const Subsystem& s, std::string_view name) {
  const auto found = s.parameters.find(std::string(name));
  const auto* given = found == s.parameters.end() ? nullptr : std::get_if<std::vector<std::string>>(&found->second);
  return given ? *given : std::vector<std::string>{};
}

/// Whether the algorithm has a list of this name.
bool has_parameter(const Description& d, std::string_view name) {
  return std::any_of(d.parameters.begin(), d.parameters.end(),
                     [&](const Parameter& p) { return p.name == name && p.type == ParameterType::texts; });
}

bool is_named(const Subsystem& s, const std::string& joint) {
  for (const auto& [list, mode] : lists)
    for (const std::string& pattern : list_in(s, list->name))
      if (detail::names_joint(pattern, joint)) return true;
  return false;
}

/// The drive of a joint in a model.
struct ModelDrive {
  std::string joint;
  DriveMode mode = DriveMode::passive;
  std::optional<double> stiffness{}, damping{};  ///< for a joint that follows positions
};

template <class T>
std::optional<T> constant_of(const RobotTree::Component& component, const Key<T>& key) {
  for (const RobotTree::Constant& c : component.constants) {
    T value{};
    if (c.key.name != key.name || c.data.size() != sizeof value) continue;
    std::memcpy(&value, c.data.data(), sizeof value);
    return value;
  }
  return std::nullopt;
}

std::vector<ModelDrive> drives_of(const RobotTree& tree) {
  std::vector<ModelDrive> drives;
  for (const RobotTree::FlatLink& link : tree.links()) {
    if (link.joint < 0) continue;
    const RobotTree::Component& joint = tree.components()[std::size_t(link.joint)];
    if (const auto mode = constant_of(joint, keys::joint_drive))
      drives.push_back({joint.name, DriveMode(*mode), constant_of(joint, keys::joint_drive_stiffness),
                        constant_of(joint, keys::joint_drive_damping)});
  }
  return drives;
}

void append(Subsystem& s, std::string_view list, std::string entry) {
  std::vector<std::string> entries = list_in(s, list);
  entries.push_back(std::move(entry));
  s.parameters[std::string(list)] = std::move(entries);
}

/// Takes modes from the model for joints that the subsystem does not name, and gains if the subsystem has none.
void add_drives(Subsystem& s, const Description& d, const std::vector<ModelDrive>& drives) {
  const Subsystem given = s;
  const bool takes_gains =
      has_parameter(d, stiffness) && has_parameter(d, damping) && given.parameters.count(std::string(stiffness)) == 0 &&
      given.parameters.count(std::string(damping)) == 0 && given.parameters.count(std::string(natural_frequency)) == 0;
  for (const ModelDrive& drive : drives) {
    if (is_named(given, drive.joint)) continue;
    for (const auto& [list, mode] : lists)
      if (mode == drive.mode && has_parameter(d, list->name)) append(s, list->name, drive.joint);
    if (!takes_gains || drive.mode != DriveMode::position) continue;
    if (drive.stiffness) append(s, stiffness, fmt::format("{}={}", drive.joint, *drive.stiffness));
    if (drive.damping) append(s, damping, fmt::format("{}={}", drive.joint, *drive.damping));
  }
}

/// Adds drives to a motion, and to the motion of its shadow.
void add_to_motion(Subsystem& s, const std::vector<ModelDrive>& drives, Algorithms& algorithms) {
  if (s.use.starts_with("motion.") && s.parameters.count("joints") == 0)
    if (const Description* const d = algorithms.describe(s)) add_drives(s, *d, drives);
  if (!s.shadow) return;
  auto shadow = std::make_shared<Subsystem>(*s.shadow);
  add_to_motion(*shadow, drives, algorithms);
  s.shadow = std::move(shadow);
}

}  // namespace

void add_model_drives(RobotTemplate& t, const RobotTree& tree, Algorithms& algorithms) {
  const std::vector<ModelDrive> drives = drives_of(tree);
  if (drives.empty()) return;
  SubsystemsOfRobots changed;
  for (std::vector<Subsystem> list : t.subsystems.lists()) {
    for (Subsystem& s : list) add_to_motion(s, drives, algorithms);
    changed.add_list(std::move(list));
  }
  for (std::size_t i = 0; i < t.subsystems.size(); ++i) changed.add(t.subsystems.list_of(i));
  t.subsystems = std::move(changed);
}

}  // namespace muro::host
