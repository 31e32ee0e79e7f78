// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "message.hpp"
#include "muro/robot_builder.hpp"
#include "muro/toolkit/joint_drives.hpp"
#include "muro/vocabulary.hpp"

namespace muro::model_file {

/// The spring of a joint. Robots have it as a position drive without damping: effort = stiffness (reference - q).
struct JointSpring {
  double stiffness = 0;  ///< N m/rad or N/m, above 0
  double reference = 0;  ///< rad or m

  /// Sets constants of the last joint of the builder.
  void add_to(RobotBuilder& builder) const {
    builder.set(keys::joint_drive, std::uint32_t(DriveMode::position));
    builder.set(keys::joint_drive_stiffness, stiffness);
    builder.set(keys::joint_drive_damping, 0.0);
    builder.set(keys::joint_position_target, reference);
  }
  std::string note() const {
    return concat(" has a spring of ", stiffness, " towards ", reference,
                  ": a position drive where the scenario does not say otherwise");
  }
};

}  // namespace muro::model_file
