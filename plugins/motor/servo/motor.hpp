// SPDX-License-Identifier: MIT
// What a DC motor at a fixed voltage can do.
#pragma once

#include "pid_controller.hpp"

namespace muro::servo {

/// At the output. The speed-torque line of data sheets, in four quadrants: with the full voltage in either direction
/// the effort is +-stall - slope v, so a motor brakes harder than it stalls, up to its limit of current, and a load
/// that turns it faster than its no-load speed is braked. (Maxon, key information on DC motors: speed-torque gradient.)
struct Motor {
  static constexpr double unlimited = 1e30;
  double stall = unlimited;       ///< N m or N, at standstill
  double slope = 0;               ///< N m s/rad or N s/m: stall effort by no-load speed
  double max_effort = unlimited;  ///< N m or N: at the largest current

  /// At the speed `v` (rad/s or m/s).
  EffortLimits limits(double v) const {
    return {std::clamp(-stall - slope * v, -max_effort, max_effort),
            std::clamp(stall - slope * v, -max_effort, max_effort)};
  }
};

}  // namespace muro::servo
