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
  double effort = std::numeric_limits<double>::infinity();  ///< maximum, N m or N
  int actuator = -1;                                        ///< number of the actuator; -1: none
  double stiffness = 0, damping = 0;                        ///< gains of a position servo, at the joint
};

struct Drives {
  std::vector<Drive> of_joint;                        ///< one for each joint
  std::vector<std::pair<int, std::string>> left_out;  ///< actuators without a counterpart, each with the reason
  bool any = false;                                   ///< whether any joint has a drive
};

/// Returns the drives of all joints. A motor becomes an effort drive, a position servo a position drive, a velocity
/// servo a velocity drive. Only the first actuator of a joint counts.
Drives drives_of(const mjModel& m);

}  // namespace muro::mjcf
