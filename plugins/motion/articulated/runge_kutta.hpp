// SPDX-License-Identifier: MIT
// The classical method of Runge and Kutta, order 4, for smooth motion within a step: gravity, inertia and the
// velocities of bodies. The effects of drives, friction, stops and contacts in the step are found first, as always, and
// stay constant: efforts along the joints, wrenches on the bodies. Held joints keep their acceleration.
#pragma once

#include "joints.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

/// State of a base, world axes, or its derivative.
template <class S>
struct BaseState {
  V3<S> position, velocity, spin;
  lane::Q4<S> orientation;

  MURO_INLINE BaseState moved_by(const BaseState& rate, S h) const {
    const lane::Q4<S>&q = orientation, &d = rate.orientation;
    return {position + h * rate.position,
            velocity + h * rate.velocity,
            spin + h * rate.spin,
            {q.x + h * d.x, q.y + h * d.y, q.z + h * d.z, q.w + h * d.w}};
  }
};

template <class S>
class RungeKutta {
 public:
  /// Starts after the trials of a step, with the efforts and wrenches that bodies have reached.
  RungeKutta(const Batch& batch, const Masses<S>& masses, const Joints<S>& joints, Work<S>& work)
      : batch_(batch), s_(batch.structure), masses_(masses), work_(work), gravity_(splat<S>(batch.gravity)) {
    for (int k = 1; k < s_.count; ++k) {
      BodyStep<S>& b = work.bodies[k];
      const JointPiece<S>& piece = work.pieces[k];
      const S sign(s_.bodies[k].sign), after = sign * (b.qd + S(batch.dt) * b.qdd);
      const S effort = sign * (piece.pull - piece.drag * after);
      b.terms.effort = select(b.terms.is_free > S(0), effort, S(0));
      b.terms.inertia = joints.armature_of(k);
      work.stages[k] = {b.q, b.qd, S(0), S(0)};
    }
    keep_wrenches();
  }

  /// Moves the joints. Returns the base at the end of the step.
  BaseState<S> carry(const BaseState<S>& start) {
    const S h(batch_.dt), half(0.5 * batch_.dt);
    const BaseState<S> k1 = rate(start);
    stage(half, S(1));
    const BaseState<S> k2 = rate(start.moved_by(k1, half));
    stage(half, S(2));
    const BaseState<S> k3 = rate(start.moved_by(k2, half));
    stage(h, S(2));
    const BaseState<S> k4 = rate(start.moved_by(k3, h));
    stage(S(0), S(1));
    const S sixth(batch_.dt / 6);
    for (int k = 1; k < s_.count; ++k) {
      const JointStage<S>& j = work_.stages[k];
      BodyStep<S>& b = work_.bodies[k];
      b.qd = j.qd + sixth * j.accelerations;
      // a held joint is at its given place: at its stop
      b.q = j.q + select(b.terms.is_free > S(0), sixth * j.velocities, h * b.qd);
    }
    BaseState<S> end = start.moved_by(k1, sixth).moved_by(k2, S(2) * sixth).moved_by(k3, S(2) * sixth);
    end = end.moved_by(k4, sixth);
    lane::Q4<S>& q = end.orientation;
    const S norm = S(1) / sqrt(q.x * q.x + q.y * q.y + q.z * q.z + q.w * q.w);
    q = {q.x * norm, q.y * norm, q.z * norm, q.w * norm};
    return end;
  }

 private:
  /// Keeps the wrenches of contacts and of external wrenches on each body, at its origin, world axes.
  void keep_wrenches() {
    const V3<S> zero{S(0), S(0), S(0)};
    for (int k = 0; k < s_.count; ++k) work_.wrenches[k] = {zero, zero};
    for (int k = 0; k < s_.count; ++k) {
      if (!work_.acts_on[k]) continue;
      const BodyStep<S>& b = work_.bodies[k];
      const Inertia<S>& m = work_.external[k];
      // A B and B' C of contacts: these are forces, not inertia
      const V3<S> torque = m.n + m.A * b.alpha + V3<S>{dot(m.B.x, b.a), dot(m.B.y, b.a), dot(m.B.z, b.a)};
      const V3<S> force = m.f + m.B.x * b.alpha.x + m.B.y * b.alpha.y + m.B.z * b.alpha.z + m.C * b.a;
      work_.wrenches[k] = {b.axes * -force, b.axes * -torque};
      S* const numbers = &work_.external[k].A.xx;
      for (int i = 0; i < Inertia<S>::numbers; ++i) numbers[i] = S(0);
    }
  }

  /// Adds the rates of the present stage with `weight`, and brings joints to the next stage, `h` (s) from the start.
  void stage(S h, S weight) {
    for (int k = 1; k < s_.count; ++k) {
      JointStage<S>& j = work_.stages[k];
      BodyStep<S>& b = work_.bodies[k];
      const S velocity = b.qd, acceleration = b.qdd;
      j.velocities += weight * velocity, j.accelerations += weight * acceleration;
      b.q = j.q + h * velocity, b.qd = j.qd + h * acceleration;
    }
    if (s_.has_mimics) follow_leaders(s_, work_, S(0) == S(0));
  }

  BaseState<S> rate(const BaseState<S>& at) {
    BodyStep<S>& base = work_.bodies[0];
    const lane::Q4<S>& q = at.orientation;
    base.axes = q.matrix();
    base.origin = at.position;
    base.w = transposed_times(base.axes, at.spin), base.v = transposed_times(base.axes, at.velocity);
    place_all(s_, work_.bodies);
    for (int k = 0; k < s_.count; ++k) {
      if (!work_.acts_on[k]) continue;
      work_.external[k].f = -transposed_times(work_.bodies[k].axes, work_.wrenches[k].linear);
      work_.external[k].n = -transposed_times(work_.bodies[k].axes, work_.wrenches[k].angular);
    }
    const V3<S> zero{S(0), S(0), S(0)};
    const V3<S> fall = s_.fixed ? transposed_times(base.axes, -gravity_) : zero;
    accelerate_all(s_, masses_, work_, fall, S(0));
    if (s_.fixed) return {zero, zero, zero, {S(0), S(0), S(0), S(0)}};
    const S half(0.5);
    const lane::Q4<S> turning = lane::Q4<S>{half * at.spin.x, half * at.spin.y, half * at.spin.z, S(0)} * q;
    return {at.velocity, base.axes * (base.a + cross(base.w, base.v)) + gravity_, base.axes * base.alpha, turning};
  }

  const Batch& batch_;
  const Structure& s_;
  const Masses<S>& masses_;
  Work<S>& work_;
  V3<S> gravity_;
};

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
