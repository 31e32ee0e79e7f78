// SPDX-License-Identifier: MIT
// Energy of a body that is hit. Contacts give it velocities for its pose at the begin of the step. At the pose of the
// end of the step, these may have more energy than the body had. Then only the part of the contact impulses counts that
// leaves the body no more energy (Stronge, Impact Mechanics, 2000, section 3.3: restitution of energy).
#pragma once

#include "flight.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

/// Returns twice the kinetic energy (J).
template <class S>
MURO_INLINE S twice_energy(const V3<S>& linear, const V3<S>& angular, S mass, const Sym<S>& inverse_tensor) {
  return dot(linear, linear) / mass + dot(angular, inverse_tensor * angular);
}

/// Takes gained energy from robots of one body. `before`: at the begin of the step; `weight`: N; `dt`: s; `which`:
/// robots that are hit, and that nothing gives energy; `pose`: of the base, at the end; `twist`: there, in and out.
/// Changes the body.
template <class S>
[[gnu::noinline]] void take_gained_energy(const Structure& s, const Masses<S>& masses, BodyStep<S>& body,
                                          const Momentum<S>& before, const V3<S>& weight, double dt, MaskOf<S> which,
                                          const lane::PoseOf<S>& pose, lane::TwistOf<S>& twist) {
  body.axes = pose.orientation.matrix();
  body.origin = pose.position;
  body.v = transposed_times(body.axes, twist.linear), body.w = transposed_times(body.axes, twist.angular);
  const Momentum<S> end = momentum_of(s, masses, &body);
  const Sym<S> inverse_tensor = inverse(end.tensor);
  const V3<S> linear = before.linear + S(dt) * weight, &angular = before.angular;
  const V3<S> impulse = end.linear - linear, turning = end.angular - angular;
  const S had = twice_energy(before.linear, angular, end.mass, inverse(before.tensor)) +
                S(2) * dot(weight, end.centre - before.centre);
  const MaskOf<S> gains = which & (twice_energy(end.linear, end.angular, end.mass, inverse_tensor) > had);
  if (!lane::any(gains)) return;
  // a part^2 + 2 b part + c = 0
  const S a = twice_energy(impulse, turning, end.mass, inverse_tensor);
  const S b = dot(linear, impulse) / end.mass + dot(angular, inverse_tensor * turning);
  const S c = twice_energy(linear, angular, end.mass, inverse_tensor) - had;
  const S root = sqrt(max(b * b - a * c, S(0)));
  const S part = min(max((root - b) / max(a, S(1e-300)), S(0)), S(1));
  const V3<S> p = linear + part * impulse, l = angular + part * turning;
  // if it was put higher than it could go on its own, no part solves this
  const S has = max(twice_energy(p, l, end.mass, inverse_tensor), S(1e-300)),
          slower = sqrt(min(max(had, S(0)) / has, S(1)));
  const V3<S> spin = inverse_tensor * (slower * l);
  const V3<S> velocity = p * (slower / end.mass) + cross(spin, pose.position - end.centre);
  twist.linear = select(gains, velocity, twist.linear);
  twist.angular = select(gains, spin, twist.angular);
}

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
