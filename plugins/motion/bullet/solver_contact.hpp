// SPDX-License-Identifier: MIT
#pragma once

#include "narrow_phase.hpp"

namespace muro::bullet {

/// A contact point between narrow phase and solver.
struct SolverContact {
  const Collider* a = nullptr;  ///< of a dynamic robot
  const Collider* b = nullptr;
  ContactPoint point;
  Vec3 relative_velocity = Vec3::Zero();    ///< m/s: of `a` against `b` at the point at the start of the step
  Vec3 tangent, bitangent;                  ///< unit: directions of friction
  Vec3 impulse = Vec3::Zero();              ///< N s, on `a`: before solve() the initial guess, then what it found
  Vec3 angular_impulse = Vec3::Zero();      ///< N m s, on `a`: of rolling and spinning resistance
  int row = -1;                             ///< in the solver; -1: too far away to act
  int spinning_row = -1, rolling_row = -1;  ///< the same, the first of two; -1: none
};

}  // namespace muro::bullet
