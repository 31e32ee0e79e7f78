// SPDX-License-Identifier: MIT
#pragma once

#include "geoms.hpp"

namespace muro::ode {

/// A contact point in a step.
struct FoundContact {
  dContact contact{};
  const GeomOwner *first = nullptr, *second = nullptr;  ///< the first belongs to a robot of this world
  Vec3 velocity = Vec3::Zero();  ///< m/s: of the first against the second at the point, when the step begins
  double inverse_mass = 0;       ///< 1/kg: inverse effective mass along the normal
  double friction = 0;           ///< of the pair
  bool is_rebound = false;       ///< restitution acts
  bool splits = false;           ///< its overlap is taken back by positions alone
  Vec3 drift = Vec3::Zero();     ///< m: how far it has crept since it holds; see ContactHistory
  Vec3 load = Vec3::Zero();      ///< of the step before: friction as part of the normal force
  double bound = 1;              ///< by which friction is bounded, as part of what the solver takes for its limit
  dJointFeedback feedback{};     ///< what it did

  Vec3 point() const { return vector_of(contact.geom.pos); }
  Vec3 normal() const { return vector_of(contact.geom.normal); }
  /// N, on the first: ODE's joint has its bodies in the order of the geoms, and that of the first has one.
  Vec3 force() const { return vector_of(feedback.f1); }
};

}  // namespace muro::ode
