// SPDX-License-Identifier: MIT
// Sum of the contact wrenches on each body.
#pragma once

#include "work.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

/// Adds up the contacts of a pack of robots, body by body, and writes the sums of its bodies for each robot.
template <class S>
class ContactSums {
 public:
  ContactSums(const RobotState* robots, int count) {
    for (int i = 0; i < lane::count_of<S>; ++i) first_[i] = i < count ? robots[i].body_wrenches : nullptr;
  }

  void start() {
    body_ = none;
    for (int i = 0; i < lane::count_of<S>; ++i) next_[i] = first_[i];
  }
  /// Adds a contact of the robots `which`, bodies in rising order: N, m, N m, in the axes of the world; `lever`: from
  /// the origin of the body.
  MURO_INLINE void add(int body, unsigned which, const V3<S>& force, const V3<S>& lever, const V3<S>& moment) {
    if (body != body_) {
      tell();
      body_ = body, which_ = 0;
      force_ = torque_ = zero();
    }
    which_ |= which;
    const V3<S> torque = cross(lever, force);
    if (which == lane::all_lanes<S>) {
      force_ += force, torque_ += torque, torque_ += moment;
      return;
    }
    const lane::MaskOf<S> has_one = lane::mask_of<S>(which);
    force_ += select(has_one, force, zero());
    torque_ += select(has_one, torque, zero());
    torque_ += select(has_one, moment, zero());
  }
  /// Writes the sums of the body whose contacts were added last.
  MURO_INLINE void tell() {
    if (body_ == none) return;
    body_ = none;
    lane::Places<S, double> to;
    unsigned told = 0;
    for (int i = 0; i < lane::count_of<S>; ++i) {
      to.at[i] = nullptr;
      if (!next_[i] || !(which_ >> i & 1)) continue;
      to.at[i] = *next_[i]++;
      told |= 1u << i;
    }
    if (told != 0) store_numbers(to, 0, {force_.x, force_.y, force_.z, torque_.x, torque_.y, torque_.z}, told);
  }

 private:
  static constexpr int none = -1;
  MURO_INLINE static V3<S> zero() { return {S(0), S(0), S(0)}; }

  double* const* first_[lane::count_of<S>];
  double* const* next_[lane::count_of<S>];
  int body_ = none;
  unsigned which_ = 0;
  V3<S> force_, torque_;
};

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
