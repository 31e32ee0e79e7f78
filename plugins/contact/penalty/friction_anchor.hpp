// SPDX-License-Identifier: MIT
// The friction anchor of one contact point: the only state of contacts.
#pragma once

#include "muro/key.hpp"
#include "plugins/common/contact_geometry/kept_contact.hpp"

namespace muro::penalty {

/// The tangential displacement of a friction spring; found again by what it belongs to (kept_contact.hpp).
struct FrictionAnchor {
  std::uint64_t pair = 0;
  Vec3 point = Vec3::Zero();         ///< m, world
  Vec3 displacement = Vec3::Zero();  ///< m, world: tangential
  double overlap = 0;                ///< m, see overlap.hpp
  Vec3 way = Vec3::Zero();           ///< m, world: of the point in the last step, where it moves over a single body
};

using contact_geometry::pair_of, contact_geometry::previous;

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
