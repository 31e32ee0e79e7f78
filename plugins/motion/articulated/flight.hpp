// SPDX-License-Identifier: MIT
// Flight of a robot that touches nothing, or is one body that contacts push. Gravity, wrenches from outside and its
// momentum determine the motion of its base. So momenta are kept to rounding, whatever its joints do. A rigid body
// turns by the midpoint rule on its angular momentum (Hairer, Lubich, Wanner, Geometric Numerical Integration, section
// VII.5), as in motion.simplified.
#pragma once

#include "plugins/common/lanes/rotation.hpp"
#include "work.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

/// Momentum of all bodies; world axes.
template <class S>
struct Momentum {
  V3<S> linear;   ///< N s
  V3<S> angular;  ///< N m s, about the centre of mass
  V3<S> centre;   ///< m: centre of mass
  S mass;         ///< kg
  Sym<S> tensor;  ///< kg m^2, about the centre
};

/// Returns the momentum of bodies that are placed.
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

/// Returns the twist of the base at `at` (m), of a robot that has the momentum `resting` while its base rests.
template <class S>
MURO_INLINE lane::TwistOf<S> base_twist(const Momentum<S>& resting, const V3<S>& linear, const V3<S>& angular,
                                        const V3<S>& at) {
  const V3<S> spin = inverse(resting.tensor) * (angular - resting.angular);
  return {(linear - resting.linear) * (S(1) / resting.mass) + cross(spin, at - resting.centre), spin};
}

/// A base in flight over a step, beside the other parts of the step.
template <class S>
class Flight {
 public:
  /// Finds the momentum at the start. Bodies are placed as the step begins.
  Flight(const Structure& s, const Masses<S>& masses, Work<S>& work)
      : s_(s), masses_(masses), work_(work), start_(momentum_of(s, masses, work.bodies)) {}

  const Momentum<S>& start() const { return start_; }

  /// Moves the base after the joints have moved. `untouched`: robots whose bodies are placed at the middle of the step,
  /// with the position of the start; those of the others are placed at the start. `force`, `torque`: from outside, at
  /// the origin of the base; with those of contacts if the base is the only body. Changes bodies.
  void carry(lane::PoseOf<S>& pose, lane::TwistOf<S>& twist, MaskOf<S> untouched, bool all_are, const V3<S>& gravity,
             const V3<S>& force, const V3<S>& torque, double dt) {
    const S h(dt), half(0.5 * dt);
    BodyStep<S>* const bodies = work_.bodies;
    for (int k = 1; k < s_.count; ++k) {
      const JointStage<S>& j = work_.stages[k];
      BodyStep<S>& b = bodies[k];
      work_.ends[k] = {b.q, b.qd};
      b.q = select(untouched, j.q + half * j.qd, b.q - half * j.velocities), b.qd = j.velocities;
    }
    const lane::Q4<S> turned_half = lane::turned(lane::rotation_by(twist.angular * half), pose.orientation);
    const Momentum<S> middle = all_are ? at_rest_where_it_is() : at_rest(pose.position, turned_half);
    const V3<S> acts_at = select(untouched, middle.centre, start_.centre);
    const V3<S> turning = torque + cross(pose.position - acts_at, force), pull = force + start_.mass * gravity;
    const V3<S> spin_half = inverse(middle.tensor) * (start_.angular + half * turning - middle.angular);
    for (int k = 1; k < s_.count; ++k) bodies[k].q = work_.ends[k].q, bodies[k].qd = work_.ends[k].qd;
    const lane::Q4<S> turned = lane::turned(lane::rotation_by(spin_half * h), pose.orientation);
    const Momentum<S> end = at_rest(pose.position, turned);
    const V3<S> linear = start_.linear + h * pull, angular = start_.angular + h * turning;
    const V3<S> centre = start_.centre + (half / start_.mass) * (start_.linear + linear);
    twist = base_twist(end, linear, angular, pose.position);
    pose = {pose.position + centre - end.centre, turned};
  }

 private:
  /// Returns the momentum while the base does not move.
  Momentum<S> at_rest(const V3<S>& position, const lane::Q4<S>& orientation) {
    BodyStep<S>& base = work_.bodies[0];
    base.axes = orientation.matrix();
    base.origin = position;
    base.w = base.v = {S(0), S(0), S(0)};
    place_all(s_, work_.bodies);
    return momentum_of(s_, masses_, work_.bodies);
  }
  Momentum<S> at_rest_where_it_is() {
    work_.bodies[0].w = work_.bodies[0].v = {S(0), S(0), S(0)};
    find_velocities(s_, work_.bodies);
    return momentum_of(s_, masses_, work_.bodies);
  }

  const Structure& s_;
  const Masses<S>& masses_;
  Work<S>& work_;
  Momentum<S> start_;
};

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
