// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace muro::wheels {

/// Acceleration from which on there is no limit: the velocity jumps.
inline constexpr double unlimited = 1e9;

/// The velocity (rad/s) of a joint during a step: constant acceleration until `end`, then constant.
struct VelocityRamp {
  double initial = 0;       ///< rad/s
  double acceleration = 0;  ///< rad/s^2
  double end = 0;           ///< s since the begin of the step
  double final = 0;         ///< rad/s, from `end` on

  double velocity_at(double t) const { return t < end ? initial + acceleration * t : final; }
  double acceleration_at(double t) const { return t < end ? acceleration : 0; }
  /// Returns the angle (rad) by which the joint turns in the first `t` seconds, t >= end.
  double angle(double t) const { return 0.5 * (initial + final) * end + final * (t - end); }
};

/// Returns the ramp from velocity `from` to `target`, with an acceleration of at most `max_acceleration`, in a step of
/// `dt` (s).
inline VelocityRamp velocity_ramp(double from, double target, double max_acceleration, double dt) {
  if (max_acceleration >= unlimited || from == target) return {target, 0, 0, target};
  const double needed = std::abs(target - from) / max_acceleration;
  const double acceleration = std::copysign(max_acceleration, target - from);
  if (needed < dt) return {from, acceleration, needed, target};
  return {from, acceleration, dt, from + acceleration * dt};
}

}  // namespace muro::wheels
