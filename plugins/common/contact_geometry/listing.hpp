// SPDX-License-Identifier: MIT
// Which contacts a robot's list has, and how it is ordered.
#pragma once

#include <algorithm>

#include "muro/scene.hpp"
#include "muro/vocabulary.hpp"

namespace muro::encounters {

/// Whether the contact algorithm answers for a pair of robots whose contacts these worlds answer for; see
/// keys::contact_world. Scenery counts as a robot that no force moves.
inline bool is_listed(std::uint64_t own, std::uint64_t other) {
  return own == keys::contact_for_all || (own != 0 && other != 0 && own != other);
}

/// A contact of two shapes without its numbers.
Contact contact_between(const Collider& own, const Collider& other);

/// Behind the last that has the same body as the first.
template <class It>
It end_of_body(It first, It end) {
  return std::find_if(first, end, [&](const auto& n) { return n.collider->body != first->collider->body; });
}

}  // namespace muro::encounters
