// SPDX-License-Identifier: MIT
#pragma once

#include "narrow_phase.hpp"
#include "plugins/common/contact_geometry/contact_patches.hpp"

namespace muro::bullet {

/// A contact point, passed from narrow phase to solver.
struct SolverContact {
  const Collider* a = nullptr;  ///< collider of a dynamic robot
  const Collider* b = nullptr;
  ContactPoint point;
  Vec3 relative_velocity = Vec3::Zero();    ///< m/s: of `a` relative to `b` at the point at the start of the step
  double relative_spin = 0;                 ///< rad/s: of `a` relative to `b` about the normal, at the start
  Vec3 cell = Vec3::Zero();                 ///< m: from the point to the middle of its cell (pressure_cells.hpp)
  Vec3 tangent, bitangent;                  ///< unit: directions of friction
  Vec3 impulse = Vec3::Zero();              ///< N s, on `a`: before solve() the initial guess, then its result
  Vec3 angular_impulse = Vec3::Zero();      ///< N m s, on `a`: by rolling and spinning resistance
  int row = -1;                             ///< index in the solver; -1: too far away to act
  int spinning_row = -1, rolling_row = -1;  ///< indices in the solver, rolling_row of the first of two; -1: none

  /// m/s: velocity of the middle of the cell across the normal, at the start of the step.
  Vec3 slip() const {
    const Vec3 velocity = relative_velocity + relative_spin * point.normal.cross(cell);
    return velocity - point.normal * point.normal.dot(velocity);
  }
  /// m/s: speed of the ends of the cell about its middle.
  double speed_of_ends() const { return contact_geometry::speed_of_ends(relative_spin, cell); }
};

}  // namespace muro::bullet
