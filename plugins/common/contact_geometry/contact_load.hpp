// SPDX-License-Identifier: MIT
// Loads of the springs along the normal of a contact, in laws that are implicit in the step; over a double or SIMD
// lanes.
#pragma once

#include "muro/simd/geometry.hpp"

namespace muro::contact_geometry {

/// Acceleration (m/s^2) that converts masses to loads.
inline constexpr double standard_gravity = 9.80665;
/// Time (s) of a mean load: a contact is made stiff for its mean over it, if that is more than bodies weigh.
inline constexpr double load_mean_over = 0.1;
/// Limit of stiffness: a contact is made stiff for at most so many times what bodies weigh.
inline constexpr double most_weights = 100;

inline namespace MURO_ISA {

/// Returns the depth (m) whose spring acts. Bodies that enter each other within long steps are parted slowly, because
/// otherwise they would be thrown; deep ones are parted faster. `full` (m): acting depth for an overlap of a tenth of a
/// metre and more. `least` (m): acting depth at which one spring carries twice the whole load.
template <class S>
MURO_INLINE S parted_depth(S depth, S full, S least) {
  constexpr double least_part = 0.04, depth_at_full_speed = 0.1;  // m
  const S part = lane::max(lane::min(depth * S(1 / depth_at_full_speed), S(1)), S(least_part));
  return lane::min(depth, lane::max(part * full, least));
}

}  // namespace MURO_ISA
}  // namespace muro::contact_geometry
