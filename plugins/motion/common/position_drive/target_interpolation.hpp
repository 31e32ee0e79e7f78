// SPDX-License-Identifier: MIT
// Interpolates the targets that a controller gives at its own rate for the steps of a motion.
#pragma once

#include <cmath>
#include <span>

namespace muro {

/// Wanted state of a joint at the end of a step.
struct Reference {
  double position = 0;  ///< rad or m
  double velocity = 0;  ///< rad/s or m/s, within the step
};

/// Moves evenly from its present value to each new target within `period` (s). If the controller has that period,
/// targets of constant speed become a motion of constant speed, one period later. It keeps `numbers` values in a state
/// block, all 0 before the first step, and begins at the joint's position.
class TargetInterpolation {
 public:
  static constexpr std::size_t numbers = 4;

  TargetInterpolation() = default;
  explicit TargetInterpolation(std::span<double> memory) : memory_(memory) {}

  /// Starts anew with the next step.
  void invalidate() const {
    if (!memory_.empty()) memory_[is_valid] = 0;
  }
  /// Advances it by `dt` (s). `position`: position of the joint.
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
    // A period is a whole number of steps up to round-off. Round-off must not make one more step.
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
