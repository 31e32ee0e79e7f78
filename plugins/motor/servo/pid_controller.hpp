// SPDX-License-Identifier: MIT
// The digital controller of a servo.
#pragma once

#include <algorithm>

namespace muro::servo {

/// Limits of an effort, N m or N, min <= max.
struct EffortLimits {
  double min = 0, max = 0;
};

/// A PID controller of a position, or a PI controller of a velocity.
struct PidController {
  bool follows_velocity = false;  ///< false: follows a position
  double stiffness = 0;           ///< N m/rad
  double damping = 0;             ///< N m s/rad
  double integral = 0;            ///< N m/(rad s), gain of the integral of the position error

  /// Returns the effort (N m or N) for `target`, within `limits`. Updates `i`, the effort of the integral term.
  ///
  /// Position: stiffness e + i - damping v, with i' = integral e. Velocity: damping e + i, with i' = stiffness e. The
  /// integral does not grow while the effort is at a limit and the error asks for more, and is never beyond the limits
  /// (conditional integration: Astrom and Hagglund, PID Controllers, Section 3.5).
  double effort(double target, double position, double velocity, const EffortLimits& limits, double& i,
                double dt) const {
    const double error = target - (follows_velocity ? velocity : position);
    const double proportional = follows_velocity ? damping * error : stiffness * error - damping * velocity;
    const double wanted = proportional + i;
    const double saturated = std::clamp(wanted, limits.min, limits.max);
    const double gain = follows_velocity ? stiffness : integral;
    if (gain > 0 && (wanted == saturated || (wanted > saturated) != (error > 0)))
      i = std::clamp(i + gain * error * dt, std::min(limits.min, 0.0), std::max(limits.max, 0.0));
    return saturated;
  }
};

}  // namespace muro::servo
