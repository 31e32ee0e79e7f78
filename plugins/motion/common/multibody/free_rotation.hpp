// SPDX-License-Identifier: MIT
// The rotation of a rigid body on which no torque acts.
#pragma once

#include "muro/geometry.hpp"

namespace muro::multibody {

struct FreeRotation {
  Quat orientation;  ///< body to world, unit
  Vec3 spin;         ///< rad/s, world axes

  /// Advances the rotation by `dt` (s) by Euler's equations, exact up to round-off. `inertia` and its `inverse`: about
  /// the centre of mass, axes of the body.
  ///
  /// Uses Taylor series. Their coefficients have a recurrence because the equations are quadratic: dL/dt = L x I^-1 L
  /// and dq/dt = q I^-1 L / 2, with the angular momentum L in axes of the body (Barrio, Performance of the Taylor
  /// series method for ODEs/DAEs, Applied Mathematics and Computation 163, 2005). Turns of more than 0.1 rad are split
  /// into several parts. No elementary function is used, so the bits are the same on every machine.
  void advance(const Mat3& inertia, const Mat3& inverse, double dt);
};

}  // namespace muro::multibody
