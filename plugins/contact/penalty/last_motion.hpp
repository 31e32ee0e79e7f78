// SPDX-License-Identifier: MIT
// What a body did in the last step, from which follows what else acts on it: joints, and contacts of its own motion.
#pragma once

#include "muro/key.hpp"
#include "muro/vocabulary.hpp"

namespace muro::penalty {

/// Of a body of a robot whose contacts were solved together with those of others.
struct LastMotion {
  std::int64_t time = -1;  ///< ns: of that step; -1: never
  Twist twist;             ///< at its begin
  Wrench wrench;           ///< of contacts, in that step
};

}  // namespace muro::penalty

namespace muro {
MURO_OPAQUE_TYPE(penalty::LastMotion, "muro.contact.penalty.LastMotion", opaque);
}  // namespace muro

namespace muro::penalty {
inline constexpr Key<LastMotion> last_motions{"contact.last_motions", "m/s, N",
                                              "list on the base of a robot: what its bodies did in the last step"};
}  // namespace muro::penalty
