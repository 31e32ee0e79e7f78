// SPDX-License-Identifier: MIT
// The joints of a pack of robots within a step.
#pragma once

#include "moved_inertias.hpp"
#include "work.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

using lane::load, lane::load_rows, lane::store_rows;

template <class S>
class Joints {
 public:
  /// Loads positions and velocities.
  MURO_INLINE Joints(const Batch& batch, const RobotState* robots, int count, Work<S>& work)
      : batch_(batch), s_(batch.structure), work_(work) {
    for (int i = 0; i < lane::count_of<S>; ++i) {
      const RobotState& r = robots[i < count ? i : 0];
      positions_.at[i] = r.positions, velocities_.at[i] = r.velocities, efforts_.at[i] = r.efforts;
      for (int d = 0; d < target_kinds; ++d) targets_[d].at[i] = r.targets[d];
      friction_losses_.at[i] = r.friction_losses, armature_losses_.at[i] = r.armature_losses;
    }
    each_row([&]<int n>(int k, std::integral_constant<int, n>) {
      S q[n], qd[n];
      load_rows(as_read(positions_), s_.joints[k].position, q);
      load_rows(as_read(velocities_), s_.joints[k].velocity, qd);
      for (int i = 0; i < n; ++i) {
        const S sign(s_.bodies[k + i].sign);
        work_.bodies[k + i].q = sign * q[i], work_.bodies[k + i].qd = sign * qd[i];
      }
    });
  }

  /// What acts along each joint, and the piece of it to try first. Bodies have been placed.
  void find_laws(const Masses<S>& masses) {
    if (s_.needs_inertia) find_moved_inertias(s_, masses, work_.bodies, work_.composites);
    for (int k = 1; k < s_.count; ++k) {
      const Joint& joint = s_.joints[k];
      work_.armature[k] = S(joint.armature);
      work_.laws[k] = law_of(k);
      work_.changes[k] = S(0);
      work_.pieces[k] = guess(work_.laws[k], position_and_velocity(k).velocity);
    }
  }

  void set_terms() {
    for (int k = 1; k < s_.count; ++k) {
      JointTerms<S> t = terms_of(work_.pieces[k], work_.armature[k], position_and_velocity(k).velocity, batch_.dt);
      t.effort *= S(s_.bodies[k].sign), t.rate *= S(s_.bodies[k].sign);
      work_.bodies[k].terms = t;
    }
  }

  /// Whether some joint has come to another piece of its law than the one that was tried, which is then the next to be.
  bool look_again() {
    constexpr unsigned all = lane::all_lanes<S>;
    unsigned changed = 0;
    for (int k = 1; k < s_.count; ++k) {
      if (s_.joints[k].leader >= 0) continue;
      const BodyStep<S>& b = work_.bodies[k];
      JointPiece<S>& tried = work_.pieces[k];
      const JointLaw<S>& law = work_.laws[k];
      const S sign(s_.bodies[k].sign), v = sign * b.qd, after = v + sign * S(batch_.dt) * b.qdd;
      const auto goes = goes_on(law, tried, after);
      tried.effort = law.pull - law.drag * after;
      if (lane::bits(goes) == all) continue;
      const S implicit = b.terms.inertia - work_.armature[k], inertia = b.D - implicit;
      S load = sign * (b.needed + b.terms.effort);
      if (s_.has_mimics) load -= sign * work_.couplings[k];
      const auto rests = stays_at_rest(law, tried, load + sign * inertia * b.qdd);
      tried.effort = select(rests, clamp(law.pull, -law.effort, law.effort), tried.effort);
      const auto stays = goes | rests;
      if (lane::bits(stays) == all) continue;
      const JointPiece<S> found = meet(law, inertia, v - S(batch_.dt) * load / inertia, batch_.dt);
      const auto same = stays | (tried == found);
      // the second change of mind is the last
      S& changes = work_.changes[k];
      const auto wavers = (!same) & (changes >= S(1));
      changes = select(same, changes, changes + S(1));
      JointPiece<S> next = found;
      auto settled = same;
      if (lane::bits(wavers) != 0) {
        const JointPiece<S> soft = damped(law, found, found.velocity);
        settled = same | (wavers & are_alike(soft, tried));
        next = chosen(wavers, soft, found);
      }
      changed |= lane::bits(!settled);
      const S effort = select(stays, tried.effort, found.effort);
      tried = chosen(settled, tried, next);
      tried.effort = effort;
    }
    return changed != 0;
  }

  /// Semi-implicit Euler.
  void move() {
    const S h(batch_.dt);
    for (int k = 1; k < s_.count; ++k) {
      BodyStep<S>& b = work_.bodies[k];
      b.qd += h * b.qdd;
      b.q += h * b.qd;
    }
    finish();
  }
  /// When joints have moved.
  void finish() {
    if (s_.has_mimics) follow_leaders();
  }

  void store(unsigned which) const {
    each_row([&]<int n>(int k, std::integral_constant<int, n>) {
      S q[n], qd[n], effort[n];
      for (int i = 0; i < n; ++i) {
        const S sign(s_.bodies[k + i].sign);
        q[i] = sign * work_.bodies[k + i].q, qd[i] = sign * work_.bodies[k + i].qd;
        effort[i] = work_.pieces[k + i].effort;
      }
      store_rows(positions_, s_.joints[k].position, q, which);
      store_rows(velocities_, s_.joints[k].velocity, qd, which);
      store_rows(efforts_, s_.joints[k].out_effort, effort, which);
    });
  }
  S sum() const {
    S all(0);
    for (int k = 1; k < s_.count; ++k) all += abs(work_.bodies[k].q) + abs(work_.bodies[k].qd);
    return all;
  }

  /// What keeps mimic joints with their leaders acts beside the pieces of laws.
  void add_couplings() {
    for (int k = 1; k < s_.count; ++k) work_.bodies[k].terms.effort += work_.couplings[k];
  }

 private:
  /// Calls f(k, n) for joints k to k + n - 1, whose numbers lie side by side: all, piece by piece.
  template <class F>
  MURO_INLINE void each_row(const F& f) const {
    int k = 1;
    for (; s_.lie_side_by_side && k + 4 <= s_.count; k += 4) f(k, std::integral_constant<int, 4>());
    for (; k < s_.count; ++k) f(k, std::integral_constant<int, 1>());
  }

  struct State {
    S position, velocity;
  };
  /// In the direction of the model.
  MURO_INLINE State position_and_velocity(int k) const {
    const S sign(s_.bodies[k].sign);
    return {sign * work_.bodies[k].q, sign * work_.bodies[k].qd};
  }

  /// Parts of two pieces.
  MURO_INLINE static JointPiece<S> chosen(MaskOf<S> m, const JointPiece<S>& a, const JointPiece<S>& b) {
    return {select(m, a.is_free, b.is_free), select(m, a.pull, b.pull), select(m, a.drag, b.drag),
            select(m, a.velocity, b.velocity), b.effort};
  }

  /// rad/s or m/s: at which a joint at `q` would be at its stop at the end of the step. Where it is beyond, it comes
  /// back over some steps.
  MURO_INLINE S velocity_to(double stop, S q, double side) const {
    constexpr double part = 0.05;
    const S away = S(stop) - q;
    return away * select(S(side) * away < S(0), S(part / batch_.dt), S(1 / batch_.dt));
  }

  JointLaw<S> law_of(int k) {
    const Joint& j = s_.joints[k];
    const State state = position_and_velocity(k);
    const S zero(0), infinite(Joint::infinite), speed(j.speed), h(batch_.dt);
    JointLaw<S> law{zero, zero, zero, S(j.effort), S(j.damping), S(j.friction), -infinite, infinite, j.speed, false};
    if (j.lower > -Joint::infinite) law.lowest = velocity_to(j.lower, state.position, -1);
    if (j.upper < Joint::infinite) law.highest = velocity_to(j.upper, state.position, 1);
    if (j.leader >= 0) return law;
    if (j.has_friction_loss) law.friction += load<S>(friction_losses_, j.friction_loss);
    if (j.has_armature_loss) work_.armature[k] += load<S>(armature_losses_, j.armature_loss);
    const S target = j.drive == Drive::passive ? zero : load<S>(targets_[int(j.drive)], j.target);
    switch (j.drive) {
      case Drive::effort:
        law.pull = clamp(target, -law.effort, law.effort);
        break;
      case Drive::velocity:
        law.holds_velocity = true;
        law.velocity = clamp(target, -speed, speed);
        break;
      case Drive::acceleration:
        law.holds_velocity = true;
        law.velocity = clamp(state.velocity + h * target, -speed, speed);
        break;
      case Drive::position:
        drive_to(k, target, state, law);
        break;
      case Drive::passive:
        break;
    }
    return law;
  }

  /// A PD controller with position and velocity of the end of the step: kp (target - q - h v') + kd (target velocity -
  /// v').
  MURO_INLINE void drive_to(int k, S target, const State& state, JointLaw<S>& law) {
    const Joint& j = s_.joints[k];
    S stiffness(j.stiffness), damping(j.drive_damping);
    if (j.needs_inertia()) {
      const S inertia = work_.bodies[k].D + work_.armature[k], w(j.natural_frequency);  // see find_moved_inertias
      if (j.stiffness < 0) stiffness = w * w * inertia;
      if (j.drive_damping < 0) damping = S(2) * lane::sqrt(stiffness * inertia);
    }
    const S allowed = clamp(target, S(j.lower), S(j.upper)), speed(j.speed);
    S velocity(0);
    if (j.has_target_velocity)
      velocity = select(allowed == target,
                        clamp(load<S>(targets_[int(Drive::velocity)], j.target_velocity), -speed, speed), S(0));
    law.pull = stiffness * (allowed - state.position) + damping * velocity;
    law.drag = damping + S(batch_.dt) * stiffness;
  }

  void follow_leaders() {
    for (int k = 1; k < s_.count; ++k) {
      const Joint& j = s_.joints[k];
      if (j.leader < 0) continue;
      const State leader = position_and_velocity(j.leader);
      const S sign(s_.bodies[k].sign), factor(j.multiplier);
      work_.bodies[k].q = sign * (S(j.offset) + factor * leader.position);
      work_.bodies[k].qd = sign * factor * leader.velocity;
    }
  }

  const Batch& batch_;
  const Structure& s_;
  Work<S>& work_;
  lane::Places<S, double> positions_, velocities_, efforts_;
  lane::Places<S> targets_[target_kinds], friction_losses_, armature_losses_;
};

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
