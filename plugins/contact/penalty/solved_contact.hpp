// SPDX-License-Identifier: MIT
// Data kept of a contact that was solved together with others, beside its friction anchor.
#pragma once

#include "muro/key.hpp"
#include "plugins/common/contact_geometry/kept_contact.hpp"

namespace muro::penalty {

/// Result of a contact. It is found again in the same way as the friction anchor of the contact.
struct SolvedContact {
  std::uint64_t pair = 0;
  Vec3 point = Vec3::Zero();  ///< m, world
  double load = 0;            ///< N: normal force of the last step
  double mean_load = 0;       ///< N: mean of the normal force over some steps
  double rebounds = 0;        ///< s: time for which it is a single spring, since it bounces
  double expected = 0;        ///< m/s: expected speed at which the points part at the end of the last step
  double more = 0;            ///< m/s: by which they part faster than expected, mean over some steps
};

}  // namespace muro::penalty

namespace muro {
MURO_OPAQUE_TYPE(penalty::SolvedContact, "muro.contact.penalty.SolvedContact", opaque);
}  // namespace muro

namespace muro::penalty {
inline constexpr Key<SolvedContact> solved_contacts{
    "contact.solved", "N", "list on the base of a robot: contacts that were solved together with others"};
}  // namespace muro::penalty
