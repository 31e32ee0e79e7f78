// SPDX-License-Identifier: MIT
// Contacts from step to step. Contact points have no names, so what is kept of one in the step before is found by the
// bodies and shapes that touch and by the nearest point. Bodies are named by hashes: the state does not depend on the
// order in which objects were declared.
#pragma once

#include <bit>
#include <cstdint>
#include <limits>
#include <span>

#include "muro/geometry.hpp"

namespace muro::contact_geometry {

inline std::uint64_t pair_of(std::uint64_t self, std::uint64_t other, std::uint32_t self_shape,
                             std::uint32_t other_shape) {
  return (self ^ (std::rotl(other, 17) + self_shape * 0x9E3779B97F4A7C15ull)) + other_shape * 0xC2B2AE3D27D4EB4Full;
}

/// What is kept of a contact (its pair and point) in the step before; null for a new one. `place`: how many contacts
/// of the robot came before this one; there the search begins, since contacts mostly keep their order.
template <class Kept>
const Kept* previous(std::span<const Kept> before, std::size_t place, std::uint64_t pair, const Vec3& point) {
  std::size_t i = place;
  if (i >= before.size() || before[i].pair != pair)
    for (i = 0; i < before.size() && before[i].pair != pair;) ++i;
  while (i > 0 && i < before.size() && before[i - 1].pair == pair) --i;
  const Kept* found = nullptr;
  for (double nearest = std::numeric_limits<double>::infinity(); i < before.size() && before[i].pair == pair; ++i) {
    const double distance = (before[i].point - point).squaredNorm();
    if (distance >= nearest) continue;
    nearest = distance;
    found = &before[i];
  }
  return found;
}

}  // namespace muro::contact_geometry
