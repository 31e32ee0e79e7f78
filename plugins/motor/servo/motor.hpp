// SPDX-License-Identifier: MIT
// Effort limits of a DC motor at a fixed voltage.
#pragma once

#include "pid_controller.hpp"

namespace muro::servo {

/// A DC motor, at the output: the speed-torque line of data sheets in four quadrants. With full voltage in either
/// direction the effort is +-stall - slope v. So it brakes with more than its stall effort, up to its current limit,
/// also a load that turns it faster than its no-load speed. (Maxon, key information on DC motors: speed-torque
/// gradient.)
struct Motor {
  static constexpr double unlimited = 1e30;
  double stall = unlimited;       ///< N m or N, at standstill
  double slope = 0;               ///< N m s/rad or N s/m: stall effort / no-load speed
  double max_effort = unlimited;  ///< N m or N: at the largest current

  /// Returns the limits at the speed `v` (rad/s or m/s).
  EffortLimits limits(double v) const {
    return {std::clamp(-stall - slope * v, -max_effort, max_effort),
            std::clamp(stall - slope * v, -max_effort, max_effort)};
  }
};

}  // namespace muro::servo
