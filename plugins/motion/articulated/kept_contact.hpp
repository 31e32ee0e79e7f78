// SPDX-License-Identifier: MIT
// State that a contact point keeps from step to step.
#pragma once

#include "batch.hpp"
#include "muro/key.hpp"

namespace muro::articulated {

struct KeptContact {
  std::uint64_t pair = 0;            ///< see contact_geometry/kept_contact.hpp
  Vec3 point = Vec3::Zero();         ///< m, world
  Vec3 way = Vec3::Zero();           ///< m, world: way of the point in the step before
  Vec3 displacement = Vec3::Zero();  ///< m, world: stretch of the friction spring
  double load = 0;                   ///< N: normal force of the last step; 0: not known, `unloaded`: none
  double mean_load = 0;              ///< N: mean normal force over some steps
  Vec3 turn = Vec3::Zero();          ///< rad, world: turn of the spring against rolling and spinning
};
static_assert(sizeof(KeptContact) == (1 + kept_numbers) * sizeof(double));

}  // namespace muro::articulated

namespace muro {
MURO_OPAQUE_TYPE(articulated::KeptContact, "muro.motion.articulated.KeptContact", opaque);
}  // namespace muro

namespace muro::articulated {
inline constexpr Key<KeptContact> kept_contacts{"contact.kept", "m",
                                                "list on the base of a robot: friction springs and loads of contacts"};
}  // namespace muro::articulated
