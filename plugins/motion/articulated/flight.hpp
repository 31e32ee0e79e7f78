// SPDX-License-Identifier: MIT
// The flight of a robot that touches nothing: gravity, wrenches from outside and its momentum say how its base moves.
// So momenta are kept to rounding, whatever its joints do, and a rigid body turns by the midpoint rule on its angular
// momentum (Hairer, Lubich, Wanner, Geometric Numerical Integration, section VII.5), as at motion.simplified.
#pragma once

#include "moved_inertias.hpp"
#include "plugins/common/lanes/rotation.hpp"

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

/// The twist at the origin of the base, `at` (m), of a robot which without it has the momentum `resting`.
template <class S>
MURO_INLINE lane::TwistOf<S> base_twist(const Momentum<S>& resting, const V3<S>& linear, const V3<S>& angular,
                                        const V3<S>& at) {
  const V3<S> spin = inverse(resting.tensor) * (angular - resting.angular);
  return {(linear - resting.linear) * (S(1) / resting.mass) + cross(spin, at - resting.centre), spin};
}

/// A base in flight over a step, beside all else that the step does.
template <class S>
class Flight {
 public:
  /// Bodies are placed. `force`, `torque`: from outside, at the origin of the base; `end`: room for a number a
  /// body.
  Flight(const Structure& s, const Masses<S>& masses, BodyStep<S>* bodies, S* end, const V3<S>& gravity,
         const V3<S>& force, const V3<S>& torque)
      : s_(s), masses_(masses), bodies_(bodies), end_(end), start_(momentum_of(s, masses, bodies)) {
    torque_ = torque + cross(bodies[0].origin - start_.centre, force);
    force_ = force + start_.mass * gravity;
  }

  /// When joints have moved; bodies still have the base where it was. Changes bodies.
  void carry(lane::PoseOf<S>& pose, lane::TwistOf<S>& twist, double dt) {
    const S h(dt), half(0.5 * dt);
    for (int k = 1; k < s_.count; ++k) {
      end_[k] = bodies_[k].q;
      bodies_[k].q -= half * bodies_[k].qd;
    }
    const Momentum<S> middle =
        at_rest(pose.position, lane::turned(lane::rotation_by(twist.angular * half), pose.orientation));
    const V3<S> spin_half = inverse(middle.tensor) * (start_.angular + half * torque_ - middle.angular);
    for (int k = 1; k < s_.count; ++k) bodies_[k].q = end_[k];
    const lane::Q4<S> turned = lane::turned(lane::rotation_by(spin_half * h), pose.orientation);
    const Momentum<S> end = at_rest(pose.position, turned);
    const V3<S> linear = start_.linear + h * force_, angular = start_.angular + h * torque_;
    const V3<S> centre = start_.centre + (S(0.5 * dt) / start_.mass) * (start_.linear + linear);
    twist = base_twist(end, linear, angular, pose.position);
    pose = {pose.position + centre - end.centre, turned};
  }

 private:
  /// With a base that does not move.
  Momentum<S> at_rest(const V3<S>& position, const lane::Q4<S>& orientation) {
    const S zero(0);
    bodies_[0].axes = orientation.matrix();
    bodies_[0].origin = position;
    bodies_[0].w = bodies_[0].v = {zero, zero, zero};
    place_all(s_, bodies_);
    return momentum_of(s_, masses_, bodies_);
  }

  const Structure& s_;
  const Masses<S>& masses_;
  BodyStep<S>* bodies_;
  S* end_;  ///< rad or m: of joints at the end of the step
  Momentum<S> start_;
  V3<S> force_, torque_;
};

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
