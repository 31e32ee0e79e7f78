// SPDX-License-Identifier: MIT
// The momentum of a robot in flight, which its base is corrected by: semi-implicit Euler keeps it to the order of the
// step, since the bodies turn within it.
#pragma once

#include "moved_inertias.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

/// Of all bodies; world axes.
template <class S>
struct Momentum {
  V3<S> linear;   ///< N s
  V3<S> angular;  ///< N m s, about the centre of mass
  V3<S> centre;   ///< m, of mass
  S mass;         ///< kg
  Sym<S> tensor;  ///< kg m^2, about the centre

  /// Under gravity and a force and torque at the origin of the base, which is at `base` (m).
  MURO_INLINE void carry_on(const V3<S>& gravity, const V3<S>& force, const V3<S>& torque, const V3<S>& base, double dt) {
    const S h(dt);
    angular += h * (torque + cross(base - centre, force));
    linear += h * (force + mass * gravity);
    centre += (h / mass) * linear;
  }
};

/// Of bodies that are placed.
template <class S>
[[gnu::noinline]] Momentum<S> momentum_of(const Structure& s, const Masses<S>& masses, const BodyStep<S>* bodies) {
  const V3<S> about = bodies[0].origin;
  const S zero(0);
  Composite<S> all{zero, {zero, zero, zero}, {zero, zero, zero, zero, zero, zero}};
  V3<S> linear{zero, zero, zero}, angular = linear;
  for (int i = 0; i < s.count; ++i) {
    const BodyStep<S>& b = bodies[i];
    S n[Mass::numbers];
    masses.load(i, n);
    const V3<S> h{n[1], n[2], n[3]};
    const V3<S> p = b.axes * (n[0] * b.v + cross(b.w, h));
    const V3<S> l = b.axes * (Sym<S>{n[4], n[5], n[6], n[7], n[8], n[9]} * b.w + cross(h, b.v));
    linear += p;
    angular += l + cross(b.origin - about, p);
    all += composite_of(masses, i, b, about);
  }
  const V3<S> c = all.first * (S(1) / all.mass);
  const S square = all.mass * dot(c, c);
  Sym<S> t = all.second;
  t.xx -= square - all.mass * c.x * c.x, t.yy -= square - all.mass * c.y * c.y, t.zz -= square - all.mass * c.z * c.z;
  t.yz += all.mass * c.y * c.z, t.zx += all.mass * c.z * c.x, t.xy += all.mass * c.x * c.y;
  return {linear, angular - cross(c, linear), about + c, all.mass, t};
}

/// Gives the base of those robots that `those` says the place and the twist with which the robot, which has the
/// momentum `now`, has `wanted`.
template <class S>
MURO_INLINE void correct_base(const Momentum<S>& wanted, const Momentum<S>& now, lane::MaskOf<S> those,
                              lane::PoseOf<S>& pose, lane::TwistOf<S>& twist) {
  const V3<S> zero{S(0), S(0), S(0)};
  const V3<S> spin = select(those, inverse(now.tensor) * (wanted.angular - now.angular), zero);
  const V3<S> more = (wanted.linear - now.linear) * (S(1) / now.mass) + cross(spin, pose.position - now.centre);
  twist.angular += spin;
  twist.linear += select(those, more, zero);
  pose.position += select(those, wanted.centre - now.centre, zero);
}

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
