// SPDX-License-Identifier: MIT
// One rigid body under a wrench: the integrator of motion.simplified, over a double or a lane of robots.
#pragma once

#include "plugins/common/lanes/mass.hpp"
#include "plugins/common/lanes/rotation.hpp"

namespace muro::simplified::integrator {
inline namespace MURO_ISA {

using lane::cross, lane::dot, lane::in_world, lane::M3, lane::Mass, lane::Q4, lane::rotation_by, lane::turned, lane::V3;

/// State of a body that is described by its centre of mass. World axes.
template <class S>
struct RigidBody {
  V3<S> centre;    ///< m
  V3<S> velocity;  ///< m/s, of the centre
  Q4<S> orientation;
  V3<S> spin;  ///< rad/s
};

/// Advances the rotation by `dt` (s) under a constant `torque` (N m, world axes, about the centre of mass).
///
/// Uses the midpoint rule on the angular momentum L = R I R^T w (Hairer, Lubich, Wanner, Geometric Numerical
/// Integration, Section VII.5, in explicit form). L advances by torque * dt exactly, the attitude by the spin in the
/// middle of the step. It is of second order; without torque, |L| and its direction do not change. `inertia` (kg m^2,
/// axes of the body, about the centre of mass): at the start. `inverse_half`, `inverse_end`: inverses of the inertias
/// in the middle and at the end, equal for a rigid body. `r`: matrix of body.orientation. Returns the matrix of the new
/// orientation.
template <class S>
MURO_INLINE M3<S> advance_rotation(RigidBody<S>& body, const M3<S>& r, const M3<S>& inertia, const M3<S>& inverse_half,
                                   const M3<S>& inverse_end, const V3<S>& torque, double dt) {
  const V3<S> momentum = in_world(r, inertia, body.spin);
  const M3<S> halfway = (rotation_by(body.spin * S(0.5 * dt)) * body.orientation).matrix();
  const V3<S> spin_half = in_world(halfway, inverse_half, momentum + torque * S(0.5 * dt));
  body.orientation = turned(rotation_by(spin_half * S(dt)), body.orientation);
  const M3<S> end = body.orientation.matrix();
  body.spin = in_world(end, inverse_end, momentum + torque * S(dt));
  return end;
}

/// Advances the centre by `dt` (s) under a constant `acceleration` (m/s^2): exact. Returns its shift (m).
template <class S>
MURO_INLINE V3<S> advance_centre(RigidBody<S>& body, const V3<S>& acceleration, double dt) {
  const V3<S> shift = body.velocity * S(dt) + acceleration * S(0.5 * dt * dt);
  body.centre += shift;
  body.velocity += acceleration * S(dt);
  return shift;
}

/// Moves the base by Newton's and Euler's equations at the centre of mass: base = centre - R com. `before`, `after`:
/// mass at the start and the end of the step; `inverse_half`, `inverse_end`: inverses of the tensors in the middle and
/// at the end.
template <bool articulated, class S>
MURO_INLINE void move_base(lane::PoseOf<S>& pose, lane::TwistOf<S>& twist, const V3<S>& force,
                           const V3<S>& torque_at_base, const Mass<S>& before, const Mass<S>& after,
                           const M3<S>& inverse_half, const M3<S>& inverse_end, S inverse_mass, const V3<S>& gravity,
                           double dt) {
  const M3<S> start = pose.orientation.matrix();
  const V3<S> arm = start * before.com;
  RigidBody<S> body{pose.position + arm, twist.linear + cross(twist.angular, arm), pose.orientation, twist.angular};
  if constexpr (articulated) body.velocity += start * before.com_velocity;
  const V3<S> shift = advance_centre(body, force * inverse_mass + gravity, dt);
  const V3<S> torque = torque_at_base - cross(arm, force);
  const M3<S> end = advance_rotation(body, start, before.tensor, inverse_half, inverse_end, torque, dt);
  const V3<S> new_arm = end * after.com;
  pose.position += shift - (new_arm - arm);
  pose.orientation = body.orientation;
  twist.angular = body.spin;
  twist.linear = body.velocity - cross(body.spin, new_arm);
  if constexpr (articulated) twist.linear -= end * after.com_velocity;
}

}  // namespace MURO_ISA
}  // namespace muro::simplified::integrator
