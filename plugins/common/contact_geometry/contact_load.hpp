// SPDX-License-Identifier: MIT
// What springs along the normal of a contact bear, in laws that are implicit in the step: over a double or SIMD lanes.
#pragma once

#include "muro/simd/geometry.hpp"

namespace muro::contact_geometry {

/// m/s^2: makes loads out of masses.
inline constexpr double standard_gravity = 9.80665;
/// s: what a contact has borne in the mean of this time it is made stiff for, where that is more than bodies weigh.
inline constexpr double load_mean_over = 0.1;
/// It is made stiff for so many times what bodies weigh at most.
inline constexpr double most_weights = 100;

inline namespace MURO_ISA {

/// m: the depth whose spring acts. What falls into each other within long steps is parted slowly, else it would be
/// thrown; what is deep in, faster. `full`: m, that of overlap of a tenth of a metre and more; `least`: m, at which one
/// spring bears all twice.
template <class S>
MURO_INLINE S parted_depth(S depth, S full, S least) {
  constexpr double least_part = 0.04, depth_at_full_speed = 0.1;  // m
  const S part = lane::max(lane::min(depth * S(1 / depth_at_full_speed), S(1)), S(least_part));
  return lane::min(depth, lane::max(part * full, least));
}

}  // namespace MURO_ISA
}  // namespace muro::contact_geometry
