// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>

#include "muro/vocabulary.hpp"
#include "position_drive.hpp"
#include "target_interpolation.hpp"

namespace muro {

/// Whether an algorithm writes a target of a joint. Call it when all algorithms have connected. [setup]
inline bool is_commanded(const Connector& c, ObjectId joint, const KeyInfo& target) {
  return c.is_used(joint, target, usage::write) || c.is_used(joint, target, usage::optional_output) ||
         c.is_used(joint, target, usage::variable) || c.is_used(joint, target, usage::derived);
}

/// The targets of a position drive: `joint.position.target`, interpolated if wished, and `joint.velocity.target` when
/// something writes it.
class PositionTarget {
 public:
  PositionTarget() = default;
  /// Makes the targets of a joint. `position`: its position target; `period`: s, see `interpolate`.
  PositionTarget(ObjectId joint, const double* position, double period)
      : joint_(joint), position_(position), period_(period) {}

  /// Number of values that it keeps from step to step; part of the state, all 0 before the first step. [setup]
  std::size_t memory_size() const { return period_ > 0 ? TargetInterpolation::numbers : 0; }
  void keep_in(std::span<double> memory) { interpolation_ = TargetInterpolation(memory); }
  /// Replaces the position target, for a joint that was in mode auto. [setup]
  void follow(const double* position) { position_ = position; }
  /// Finds out whether the velocity is commanded. [setup]
  void connect_by_name(Connector& c) {
    if (is_commanded(c, joint_, keys::joint_velocity_target))
      velocity_ = c.input(joint_, keys::joint_velocity_target, 0.0);
  }
  /// Returns the commanded velocity; null when nothing writes it.
  const double* velocity() const { return velocity_.get(); }
  /// Takes the joint over from another motion that has moved it so far.
  void take_over() const { interpolation_.invalidate(); }

  /// Returns the reference for the end of a step of `dt` (s), within the limits of the model. Without a commanded
  /// velocity it has the velocity of the interpolation, or 0. `position`: position of the joint.
  Reference advance(double position, const JointLimits& limits, double dt) const {
    Reference r{*position_, 0};
    if (period_ > 0) r = interpolation_.advance(*position_, position, period_, dt);
    if (velocity_) r.velocity = *velocity_;
    const double allowed = std::clamp(r.position, limits.lower, limits.upper);
    if (allowed != r.position) return {allowed, 0};
    return {r.position, std::clamp(r.velocity, -limits.velocity, limits.velocity)};
  }

 private:
  ObjectId joint_ = no_object;
  const double* position_ = nullptr;
  In<double> velocity_;
  double period_ = 0;
  TargetInterpolation interpolation_;
};

}  // namespace muro
