// SPDX-License-Identifier: MIT
#pragma once

#include "geoms.hpp"
#include "plugins/common/contact_geometry/contact_patches.hpp"

namespace muro::ode {

/// A contact point in a step. "At the start" is at the start of the step.
struct FoundContact {
  dContact contact{};
  const GeomOwner *first = nullptr, *second = nullptr;  ///< the first belongs to a robot of this world
  Vec3 velocity = Vec3::Zero();  ///< m/s: of the first relative to the second at the point, at the start
  double inverse_mass = 0;       ///< 1/kg: inverse effective mass along the normal, the mean of its patch
  double friction = 0;           ///< coefficient of the pair
  bool is_rebound = false;       ///< restitution acts
  bool splits = false;           ///< its overlap is corrected in positions only
  Vec3 drift = Vec3::Zero();     ///< m: distance it has crept since it holds; see ContactHistory
  Vec3 load = Vec3::Zero();      ///< friction of the last step as part of the normal force
  double pressure = 0;           ///< N: normal force of the last step
  double bound = 1;              ///< limit of friction as part of the limit that the solver uses
  double spin = 0;               ///< rad/s: of the first relative to the second about the normal, at the start
  Vec3 cell = Vec3::Zero();      ///< m: from the point to the middle of its cell (pressure_cells.hpp)
  Vec3 moment = Vec3::Zero();    ///< N m, on the first: moment about the point of the last step's friction
  dJointFeedback feedback{};     ///< force and torque of the contact in the step

  Vec3 point() const { return vector_of(contact.geom.pos); }
  Vec3 normal() const { return vector_of(contact.geom.normal); }
  /// m/s: velocity of the middle of the cell across the normal, at the start of the step.
  Vec3 slip() const {
    const Vec3 n = normal(), all = velocity + of_spin();
    return all - n * n.dot(all);
  }
  /// m/s: velocity of the middle of the cell relative to the point.
  Vec3 of_spin() const { return spin * normal().cross(cell); }
  /// m/s: speed of the ends of the cell about its middle.
  double speed_of_ends() const { return contact_geometry::speed_of_ends(spin, cell); }
  /// N, force on the first geom. ODE's joint has its bodies in the order of the geoms, and the first geom has a body.
  Vec3 force() const { return vector_of(feedback.f1); }
  /// N m, torque about the centre of mass.
  Vec3 torque(bool on_first) const {
    return on_first ? Vec3(vector_of(feedback.t1) + moment) : Vec3(vector_of(feedback.t2) - moment);
  }
};

}  // namespace muro::ode
