// SPDX-License-Identifier: MIT
// Impacts at the instant in which contact begins: what a contact algorithm tells a motion beside wrenches.
//
// Contact begins within a step, and is found at its end. The force of the next step gives them the momentum of the
// impact, but not the path on which they would be by now had the impulse acted at its instant. A motion that offers
// `contact.impact.step` takes that path from `contact.impact`, in the step that begins at `contact.impact.time`.
#pragma once

#include "muro/key.hpp"

namespace muro {

/// What impulses J change that should have acted a time t before the middle of this step. World axes.
struct ImpactCorrection {
  Vec3 path = Vec3::Zero();  ///< kg m: sum of J t, the path of the centre of mass times the mass
  Vec3 turn = Vec3::Zero();  ///< kg m^2: sum of (lever x J) t, the rotation times the inertia about the centre of mass
  Vec3 carried = Vec3::Zero();  ///< kg m^2/s: sum of J t x u, where u is the velocity of the contact point

  ImpactCorrection& operator+=(const ImpactCorrection& b) {
    path += b.path;
    turn += b.turn;
    carried += b.carried;
    return *this;
  }
};
MURO_OPAQUE_TYPE(ImpactCorrection, "muro.ImpactCorrection", opaque);

namespace keys {

inline constexpr Key<double> impact_step{
    "contact.impact.step", "s",
    "on a base: its motion corrects the path after impacts, and takes steps of this length"};
inline constexpr Key<std::int64_t> impact_time{"contact.impact.time", "ns",
                                               "on a base: begin of the step that `contact.impact` is for"};
inline constexpr Key<ImpactCorrection> impact{"contact.impact", "kg m",
                                              "on a base: the path that impacts change beyond what their force does"};

}  // namespace keys
}  // namespace muro
