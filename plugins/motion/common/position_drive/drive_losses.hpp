// SPDX-License-Identifier: MIT
#pragma once

#include "muro/toolkit/joint_drives.hpp"
#include "position_target.hpp"

namespace muro {

/// Friction and rotor inertia of the drive of a joint in mode effort; 0 when nothing writes them.
struct DriveLosses {
  In<double> friction_input, armature_input;

  /// Connects the values that something writes. [setup]
  void connect_by_name(Connector& c, ObjectId joint) {
    if (is_commanded(c, joint, keys::joint_drive_friction)) friction_input = c.read(joint, keys::joint_drive_friction);
    if (is_commanded(c, joint, keys::joint_drive_armature)) armature_input = c.read(joint, keys::joint_drive_armature);
  }
  double friction() const { return friction_input ? *friction_input : 0; }  ///< N m or N
  double armature() const { return armature_input ? *armature_input : 0; }  ///< kg m^2 or kg
};

}  // namespace muro
