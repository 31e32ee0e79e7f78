// SPDX-License-Identifier: MIT
#pragma once

#include "narrow_phase.hpp"
#include "plugins/common/contact_geometry/contact_patches.hpp"

namespace muro::bullet {

/// A contact point between narrow phase and solver.
struct SolverContact {
  const Collider* a = nullptr;  ///< of a dynamic robot
  const Collider* b = nullptr;
  ContactPoint point;
  Vec3 relative_velocity = Vec3::Zero();    ///< m/s: of `a` against `b` at the point at the start of the step
  double relative_spin = 0;                 ///< rad/s: likewise, about the normal
  Vec3 cell = Vec3::Zero();                 ///< m: from the point to the middle of its cell (pressure_cells.hpp)
  Vec3 tangent, bitangent;                  ///< unit: directions of friction
  Vec3 impulse = Vec3::Zero();              ///< N s, on `a`: before solve() the initial guess, then what it found
  Vec3 angular_impulse = Vec3::Zero();      ///< N m s, on `a`: of rolling and spinning resistance
  int row = -1;                             ///< in the solver; -1: too far away to act
  int spinning_row = -1, rolling_row = -1;  ///< the same, the first of two; -1: none

  /// m/s: velocity of the middle of the cell across the normal, at the start of the step.
  Vec3 slip() const {
    const Vec3 velocity = relative_velocity + relative_spin * point.normal.cross(cell);
    return velocity - point.normal * point.normal.dot(velocity);
  }
  /// m/s: of the ends of the cell about its middle.
  double speed_of_ends() const { return contact_geometry::speed_of_ends(relative_spin, cell); }
};

}  // namespace muro::bullet
