// SPDX-License-Identifier: MIT
// The friction anchor of one contact point: the only state of contacts.
#pragma once

#include <bit>
#include <limits>
#include <span>

#include "muro/key.hpp"

namespace muro::penalty {

/// The tangential displacement of a friction spring. Contact points have no names, so the anchor of the step before is
/// found by the bodies and shapes that touch and by the nearest point. Bodies are named by hashes: the state does not
/// depend on the order in which objects were declared.
struct FrictionAnchor {
  std::uint64_t pair = 0;
  Vec3 point = Vec3::Zero();         ///< m, world
  Vec3 displacement = Vec3::Zero();  ///< m, world: tangential
  double overlap = 0;                ///< m, see overlap.hpp
};

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

}  // namespace muro::penalty

namespace muro {
MURO_OPAQUE_TYPE(penalty::FrictionAnchor, "muro.contact.penalty.FrictionAnchor", opaque);
}  // namespace muro

namespace muro::penalty {
inline constexpr Key<FrictionAnchor> anchors{"contact.friction_anchors", "m",
                                             "list on the base of a robot: friction anchors"};
inline constexpr Key<std::int64_t> last_run{"contact.time", "ns",
                                            "on the world object: when contact ran last; -1: never"};
}  // namespace muro::penalty
