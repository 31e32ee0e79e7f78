// SPDX-License-Identifier: MIT
// Targets that a controller gives at its own rate, made even for steps of a motion.
#pragma once

#include <cmath>
#include <span>

namespace muro {

/// Where a drive is to be at the end of a step.
struct Reference {
  double position = 0;  ///< rad or m
  double velocity = 0;  ///< rad/s or m/s, within the step
};

/// Moves evenly from where it is to each new target in `period` (s): for a controller of that period, targets of
/// constant speed become a motion of constant speed, a period later. It keeps `numbers` in a state block, all 0 before
/// the first step; it begins at the joint's position.
class TargetInterpolation {
 public:
  static constexpr std::size_t numbers = 4;

  TargetInterpolation() = default;
  explicit TargetInterpolation(std::span<double> memory) : memory_(memory) {}

  /// Begins anew with the next step.
  void invalidate() const {
    if (!memory_.empty()) memory_[is_valid] = 0;
  }
  /// Carries it on by `dt` (s). `position`: of the joint.
  Reference advance(double target, double position, double period, double dt) const {
    double &at = memory_[reference], &to = memory_[goal], &time = memory_[remaining];
    if (memory_[is_valid] == 0) {
      memory_[is_valid] = 1;
      at = to = position;
    }
    if (target != to) {
      to = target;
      time = period;
    }
    // A period is a whole number of steps but for round-off, of which nothing may remain for a step of its own.
    const double from = at, part = time > dt * (1 + 1e-6) ? dt / time : 1;
    at = part < 1 ? from + (to - from) * part : to;
    time = part < 1 ? time - dt : 0;
    return {at, (at - from) / dt};
  }

 private:
  static constexpr std::size_t is_valid = 0, reference = 1, goal = 2, remaining = 3;
  std::span<double> memory_;
};

}  // namespace muro
