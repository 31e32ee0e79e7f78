// SPDX-License-Identifier: MIT
// The rotation of a rigid body on which no torque acts.
#pragma once

#include "muro/geometry.hpp"

namespace muro::multibody {

struct FreeRotation {
  Quat orientation;  ///< body to world, unit
  Vec3 spin;         ///< rad/s, world axes

  /// Carries it on by `dt` (s), as Euler's equations say, to round-off. `inertia`, `inverse`: about the centre of mass,
  /// axes of the body.
  ///
  /// By the series of Taylor, whose coefficients follow from each other because the equations are quadratic:
  /// dL/dt = L x I^-1 L and dq/dt = q I^-1 L / 2, with the angular momentum L in axes of the body (Barrio, Performance
  /// of the Taylor series method for ODEs/DAEs, Applied Mathematics and Computation 163, 2005). Turns of more than
  /// 0.1 rad go in several parts. It needs no elementary function, so it has the same bits on every machine.
  void advance(const Mat3& inertia, const Mat3& inverse, double dt);
};

}  // namespace muro::multibody
