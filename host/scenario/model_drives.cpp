// SPDX-License-Identifier: MIT
#include "host/scenario/model_drives.hpp"

#include <algorithm>
#include <cstring>

#include "muro/toolkit/joint_drives.hpp"

namespace muro::host {

namespace {

/// Of joints, by reader.mjcf: a DriveMode.
constexpr std::string_view joint_drive = "joint.drive";

constexpr std::pair<const Parameter*, DriveMode> lists[] = {{&velocity_joints, DriveMode::velocity},
                                                            {&position_joints, DriveMode::position},
                                                            {&effort_joints, DriveMode::effort},
                                                            {&passive_joints, DriveMode::passive}};

std::vector<std::string> list_in(const Subsystem& s, std::string_view name) {
  const auto found = s.parameters.find(std::string(name));
  const auto* given = found == s.parameters.end() ? nullptr : std::get_if<std::vector<std::string>>(&found->second);
  return given ? *given : std::vector<std::string>{};
}

bool has_parameter(const Description& d, std::string_view name) {
  return std::any_of(d.parameters.begin(), d.parameters.end(), [&](const Parameter& p) { return p.name == name; });
}

bool is_named(const Subsystem& s, const std::string& joint) {
  for (const auto& [list, mode] : lists)
    for (const std::string& pattern : list_in(s, list->name))
      if (detail::names_joint(pattern, joint)) return true;
  return false;
}

/// The joints of a model, with what they follow.
std::vector<std::pair<std::string, DriveMode>> drives_of(const RobotTree& tree) {
  std::vector<std::pair<std::string, DriveMode>> drives;
  for (const RobotTree::FlatLink& link : tree.links()) {
    if (link.joint < 0) continue;
    const RobotTree::Component& joint = tree.components()[std::size_t(link.joint)];
    for (const RobotTree::Constant& c : joint.constants) {
      std::uint32_t mode = 0;
      if (c.key.name != joint_drive || c.data.size() != sizeof mode) continue;
      std::memcpy(&mode, c.data.data(), sizeof mode);
      drives.emplace_back(joint.name, DriveMode(mode));
    }
  }
  return drives;
}

using Drives = std::vector<std::pair<std::string, DriveMode>>;

/// The list of a subsystem, with the joints that neither it nor another list names.
void add_drives(Subsystem& s, const Description& d, const Drives& drives) {
  const Subsystem given = s;
  for (const auto& [joint, mode] : drives)
    for (const auto& [list, listed] : lists) {
      if (listed != mode || !has_parameter(d, list->name) || is_named(given, joint)) continue;
      std::vector<std::string> names = list_in(s, list->name);
      names.push_back(joint);
      s.parameters[std::string(list->name)] = std::move(names);
    }
}

}  // namespace

void add_model_drives(RobotTemplate& t, const RobotTree& tree, Algorithms& algorithms) {
  const Drives drives = drives_of(tree);
  if (drives.empty()) return;
  SubsystemsOfRobots changed;
  for (std::vector<Subsystem> list : t.subsystems.lists()) {
    for (Subsystem& s : list)
      if (s.use.starts_with("motion.") && s.parameters.count("joints") == 0)
        if (const Description* const d = algorithms.describe(s)) add_drives(s, *d, drives);
    changed.add_list(std::move(list));
  }
  for (std::size_t i = 0; i < t.subsystems.size(); ++i)
    changed.add(std::size_t(&t.subsystems[i] - t.subsystems.lists().data()));
  t.subsystems = std::move(changed);
}

}  // namespace muro::host
