// SPDX-License-Identifier: MIT
// What joints follow of which the scenario says nothing: `joints: auto`.
#pragma once

#include <algorithm>
#include <vector>

#include "position_target.hpp"

namespace muro {

/// The mode of every link's joint when all algorithms have connected. A joint that the scenario leaves open follows
/// what an algorithm writes: its position, else its velocity. Where neither is written it turns freely, as long as
/// algorithms command other joints of the robot; else nobody knows who does, a program outside may, and it follows its
/// velocity. [setup, in connect_by_name]
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
