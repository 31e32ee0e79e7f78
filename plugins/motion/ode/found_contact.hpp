// SPDX-License-Identifier: MIT
#pragma once

#include "geoms.hpp"
#include "plugins/common/contact_geometry/contact_patches.hpp"

namespace muro::ode {

/// A contact point in a step.
struct FoundContact {
  dContact contact{};
  const GeomOwner *first = nullptr, *second = nullptr;  ///< the first belongs to a robot of this world
  Vec3 velocity = Vec3::Zero();  ///< m/s: of the first against the second at the point, when the step begins
  double inverse_mass = 0;       ///< 1/kg: inverse effective mass along the normal, the mean of its patch
  double friction = 0;           ///< of the pair
  bool is_rebound = false;       ///< restitution acts
  bool splits = false;           ///< its overlap is taken back by positions alone
  Vec3 drift = Vec3::Zero();     ///< m: how far it has crept since it holds; see ContactHistory
  Vec3 load = Vec3::Zero();      ///< of the step before: friction as part of the normal force
  double pressure = 0;           ///< N: of the step before, along the normal
  double bound = 1;              ///< by which friction is bounded, as part of what the solver takes for its limit
  double spin = 0;               ///< rad/s: of the first against the second about the normal, when the step begins
  Vec3 cell = Vec3::Zero();      ///< m: from the point to the middle of its cell (pressure_cells.hpp)
  Vec3 moment = Vec3::Zero();    ///< N m, on the first: of the friction of the step before, from there to the point
  dJointFeedback feedback{};     ///< what it did

  Vec3 point() const { return vector_of(contact.geom.pos); }
  Vec3 normal() const { return vector_of(contact.geom.normal); }
  /// m/s: of the middle of the cell across the normal, when the step begins.
  Vec3 slip() const {
    const Vec3 n = normal(), all = velocity + of_spin();
    return all - n * n.dot(all);
  }
  /// m/s: velocity of the middle of the cell against that of the point.
  Vec3 of_spin() const { return spin * normal().cross(cell); }
  /// m/s: of the ends of the cell about its middle.
  double speed_of_ends() const { return contact_geometry::speed_of_ends(spin, cell); }
  /// N, on the first: ODE's joint has its bodies in the order of the geoms, and that of the first has one.
  Vec3 force() const { return vector_of(feedback.f1); }
  /// N m, about the centre of mass.
  Vec3 torque(bool on_first) const {
    return on_first ? Vec3(vector_of(feedback.t1) + moment) : Vec3(vector_of(feedback.t2) - moment);
  }
};

}  // namespace muro::ode
