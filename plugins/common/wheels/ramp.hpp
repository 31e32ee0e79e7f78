// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace muro::wheeled {

/// Accelerations from here on are as good as none: the velocity jumps.
inline constexpr double unlimited = 1e9;

/// The velocity (rad/s) of a joint during a step: constant acceleration until `end`, then constant.
struct Ramp {
  double start = 0;         ///< rad/s
  double acceleration = 0;  ///< rad/s^2
  double end = 0;           ///< s since the begin of the step
  double last = 0;          ///< rad/s, from `end` on

  double at(double t) const { return t < end ? start + acceleration * t : last; }
  double acceleration_at(double t) const { return t < end ? acceleration : 0; }
  /// What the joint turns by (rad) in the first `t` seconds, t >= end.
  double angle(double t) const { return 0.5 * (start + last) * end + last * (t - end); }
};

/// From velocity `from` to `target` with an acceleration of at most `most`, in a step of `dt` (s).
inline Ramp ramp(double from, double target, double most, double dt) {
  if (most >= unlimited || from == target) return {target, 0, 0, target};
  const double needed = std::abs(target - from) / most, a = std::copysign(most, target - from);
  if (needed < dt) return {from, a, needed, target};
  return {from, a, dt, from + a * dt};
}

}  // namespace muro::wheeled
