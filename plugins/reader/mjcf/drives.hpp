// SPDX-License-Identifier: MIT
// Actuators of a compiled model as drives of joints.
#pragma once

#include <limits>
#include <vector>

#include "muro/toolkit/joint_drives.hpp"
#include "source.hpp"

namespace muro::mjcf {

struct Drive {
  DriveMode mode = DriveMode::passive;
  double effort = std::numeric_limits<double>::infinity();  ///< N m or N, at most
  int actuator = -1;                                        ///< none
  double stiffness = 0, damping = 0;                        ///< of a position servo, at the joint
};

struct Drives {
  std::vector<Drive> of_joint;                        ///< one per joint
  std::vector<std::pair<int, std::string>> left_out;  ///< actuators, and why
  bool any = false;                                   ///< some joint has a drive
};

/// A motor is a drive by efforts, a position servo one by positions, a velocity servo one by velocities. The first
/// actuator of a joint counts.
Drives drives_of(const mjModel& m);

}  // namespace muro::mjcf
