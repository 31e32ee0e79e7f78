// SPDX-License-Identifier: MIT
#pragma once

#include "muro/toolkit/joint_drives.hpp"

namespace muro {

/// Connects the target that a joint follows in this mode; empty for passive joints. `position`: rad or m, at the start.
/// [setup]
inline In<double> connect_joint_target(Connector& c, ObjectId joint, DriveMode mode, double position) {
  switch (mode) {
    case DriveMode::velocity:
      return c.input(joint, keys::joint_velocity_target, 0.0);
    case DriveMode::position:
      return c.input(joint, keys::joint_position_target, position);
    case DriveMode::acceleration:
      return c.input(joint, keys::joint_acceleration_target, 0.0);
    case DriveMode::effort:
      return c.input(joint, keys::joint_effort_target, 0.0);
    case DriveMode::passive:
      break;
  }
  return {};
}

}  // namespace muro
