// SPDX-License-Identifier: MIT
// Targets of joints for which the scenario sets no mode: `joints: auto`.
#pragma once

#include <algorithm>
#include <vector>

#include "position_target.hpp"

namespace muro {

/// Returns the mode of every link's joint when all algorithms have connected. A joint in mode auto follows the target
/// that an algorithm writes: position, else velocity. When neither is written, the joint is passive if algorithms
/// command other joints of the robot. Otherwise a program outside may write targets, and the joint follows its velocity
/// target. [setup, in connect_by_name]
inline std::vector<DriveMode> settled_modes(const Connector& c, const RobotView& robot, const Parameters& p) {
  std::vector<bool> is_open;
  std::vector<DriveMode> modes = drive_modes_of(c, robot, p, &is_open);
  if (std::none_of(is_open.begin(), is_open.end(), [](bool open) { return open; })) return modes;
  const auto follows = [&](const Link& link, const KeyInfo& target) {
    return link.joint != JointKind::fixed && is_commanded(c, link.joint_object, target);
  };
  const bool is_driven = std::any_of(robot.links.begin(), robot.links.end(), [&](const Link& link) {
    return follows(link, keys::joint_velocity_target) || follows(link, keys::joint_position_target) ||
           follows(link, keys::joint_acceleration_target) || follows(link, keys::joint_effort_target);
  });
  if (!is_driven) return modes;
  for (std::size_t i = 0; i < modes.size(); ++i) {
    if (!is_open[i]) continue;
    const Link& link = robot.links[i];
    modes[i] = follows(link, keys::joint_position_target)   ? DriveMode::position
               : follows(link, keys::joint_velocity_target) ? DriveMode::velocity
                                                            : DriveMode::passive;
  }
  for (std::size_t i = 0; i < modes.size(); ++i)
    if (robot.links[i].mimic >= 0) modes[i] = modes[std::size_t(robot.links[i].mimic)];
  return modes;
}

}  // namespace muro
