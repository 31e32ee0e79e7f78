// SPDX-License-Identifier: MIT
// Robots on a fixed base whose moving links have no mass, so no force can move their joints. Many models of industrial
// arms are like this.
#pragma once

#include <algorithm>
#include <string>
#include <string_view>
#include <vector>

#include "muro/algorithm.hpp"
#include "muro/vocabulary.hpp"

namespace muro {

/// Whether a link that a joint can move has mass. [setup]
inline bool has_moving_mass(const Connector& c, const RobotView& robot) {
  std::vector<bool> moves(robot.links.size());
  for (std::size_t i = 1; i < moves.size(); ++i) {
    const Link& link = robot.links[i];
    moves[i] = link.joint != JointKind::fixed || moves[std::size_t(link.parent)];
    const auto inertial = c.constant(link.object, keys::inertial);
    if (moves[i] && inertial && !(inertial->mass == 0)) return true;
  }
  return false;
}

/// Logs once that these robots are moved without forces. `still`: whether some of their joints are in modes in which
/// only forces move them. [setup]
inline void tell_of_robots_without_forces(Connector& c, const std::vector<std::string>& robots, bool still) {
  if (robots.empty()) return;
  constexpr std::size_t most = 3;
  std::string text = "no link that moves has mass:";
  for (std::size_t i = 0; i < std::min(most, robots.size()); ++i) text += (i == 0 ? " `" : ", `") + robots[i] + "`";
  if (robots.size() > most) text += " and " + std::to_string(robots.size() - most) + " more";
  text += "; joints follow their targets within limits, without forces";
  if (still) text += ", and those in mode effort or passive stand still";
  c.host().log(LogLevel::info, text + " (`muro check` says what models lack)");
}

}  // namespace muro
