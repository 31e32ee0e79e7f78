// SPDX-License-Identifier: MIT
// One rigid body under a wrench: the integrator of motion.simplified, free of properties.
#pragma once

#include "muro/geometry.hpp"

namespace muro::simplified {

/// State of a body that is described by its centre of mass. World axes.
struct RigidBody {
  Vec3 centre = Vec3::Zero();    ///< m
  Vec3 velocity = Vec3::Zero();  ///< m/s, of the centre
  Quat orientation = Quat::Identity();
  Vec3 spin = Vec3::Zero();  ///< rad/s
};

/// `q` turned by `by`, then brought back to length 1: one Newton step of the norm, which is all
/// that round-off needs.
inline Quat turned(const Quat& by, const Quat& q) {
  Quat result = by * q;
  result.coeffs() *= 1.5 - 0.5 * result.coeffs().squaredNorm();
  return result;
}

/// r * v, in a form that compiles to straight code.
[[gnu::always_inline]] inline Vec3 times(const Mat3& r, const Vec3& v) {
  return r.col(0) * v.x() + r.col(1) * v.y() + r.col(2) * v.z();
}

/// A symmetric tensor in the axes of the body (r: body to world), applied to a vector in those of the world.
[[gnu::always_inline]] inline Vec3 in_world(const Mat3& r, const Mat3& tensor, const Vec3& v) {
  return times(r, times(tensor, Vec3(r.col(0).dot(v), r.col(1).dot(v), r.col(2).dot(v))));
}

/// Advances the rotation by `dt` (s) under a constant `torque` (N m, world axes, about the centre of mass).
///
/// Midpoint rule on the angular momentum L = R I R^T w (Hairer, Lubich, Wanner, Geometric Numerical
/// Integration, Section VII.5, in explicit form): L advances by torque * dt exactly, the attitude by the spin
/// that belongs to the middle of the step. Second order; without torque |L| and its direction do not change.
/// `inertia` (kg m^2, axes of the body, about the centre of mass) is that of the start; `inverse_half` and
/// `inverse_end` invert those of the middle and the end: the same for a rigid body. `r` is the matrix of
/// body.orientation; returns that of the new one.
[[gnu::always_inline]] inline Mat3 advance_rotation(RigidBody& body, const Mat3& r, const Mat3& inertia,
                                                    const Mat3& inverse_half, const Mat3& inverse_end,
                                                    const Vec3& torque, double dt) {
  const Vec3 momentum = in_world(r, inertia, body.spin);
  const Mat3 halfway = (rotation_of(Vec3(body.spin * (0.5 * dt))) * body.orientation).toRotationMatrix();
  const Vec3 spin_half = in_world(halfway, inverse_half, momentum + torque * (0.5 * dt));
  body.orientation = turned(rotation_of(Vec3(spin_half * dt)), body.orientation);
  const Mat3 end = body.orientation.toRotationMatrix();
  body.spin = in_world(end, inverse_end, momentum + torque * dt);
  return end;
}

/// Advances the centre by `dt` (s) under a constant `acceleration` (m/s^2): exact. Returns its shift (m).
[[gnu::always_inline]] inline Vec3 advance_centre(RigidBody& body, const Vec3& acceleration, double dt) {
  const Vec3 shift = body.velocity * dt + acceleration * (0.5 * dt * dt);
  body.centre += shift;
  body.velocity += acceleration * dt;
  return shift;
}

}  // namespace muro::simplified
