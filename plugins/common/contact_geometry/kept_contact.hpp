// SPDX-License-Identifier: MIT
// Contacts kept from step to step. Contact points have no names, so the kept data of a contact are found by the bodies
// and shapes that touch and by the nearest point. Bodies are named by hashes, so that the state does not depend on the
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

/// Returns what was kept in the step before of a contact, given by its pair and point; null for a new one. `place`:
/// number of contacts of the robot before this one. The search begins there, because contacts usually keep their order.
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
