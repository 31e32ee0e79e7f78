// SPDX-License-Identifier: MIT
// Joints of a pack of robots within a step.
#pragma once

#include <algorithm>

#include "mimic_joints.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

using lane::load, lane::load_rows;

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
      accelerations_.at[i] = r.accelerations;
    }
    each_row([&]<int n>(int k, std::integral_constant<int, n>) {
      S q[n], qd[n];
      load_rows(as_read(positions_), s_.joints[k].position, q);
      load_rows(as_read(velocities_), s_.joints[k].velocity, qd);
      for (int i = 0; i < n; ++i) {
        const S sign(s_.bodies[k + i].sign);
        work_.bodies[k + i].q = work_.stages[k + i].q = sign * q[i];
        work_.bodies[k + i].qd = work_.stages[k + i].qd = sign * qd[i];
      }
    });
  }

  /// Brings the joints of the robots `which` to the middle of the step. Their velocities change as in the last step;
  /// those of driven joints stay as at the begin, since drives change velocities at once.
  void go_to_middle(MaskOf<S> which) {
    const S half(0.5 * batch_.dt);
    each_row([&]<int n>(int k, std::integral_constant<int, n>) {
      for (int i = 0; i < n; ++i) {
        BodyStep<S>& b = work_.bodies[k + i];
        b.q = select(which, b.q + half * b.qd, b.q);
      }
      if (!has_carried(k, n)) return;
      S before[n];
      load_rows(as_read(accelerations_), of_base + k - 1, before);
      for (int i = 0; i < n; ++i) {
        BodyStep<S>& b = work_.bodies[k + i];
        work_.stages[k + i].accelerations = before[i];
        if (is_carried(s_.joints[k + i])) b.qd = select(which, b.qd + half * before[i], b.qd);
      }
    });
    if (s_.has_mimics) follow_leaders(s_, work_, which);
  }

  /// Finds the law of each joint, and the terms of the piece of it to try first. Bodies have been placed.
  void find_laws(const Masses<S>& masses) {
    if (s_.needs_inertia) find_moved_inertias(s_, masses, work_.bodies, work_.composites);
    for (int k = 1; k < s_.count; ++k) {
      find_law(k);
      work_.changes[k] = S(0);
      work_.pieces[k] = guess(law(k), start_of(k).velocity, work_.laws[k].bound);
      set_terms_of(k);
    }
  }

  /// Returns the armature of a joint (kg m^2 or kg).
  MURO_INLINE S armature_of(int k) const {
    const Joint& j = s_.joints[k];
    return j.has_armature_loss ? S(j.armature) + work_.laws[k].armature_loss : S(j.armature);
  }

  /// Sets the terms of the pieces to try next.
  void set_terms() {
    for (int k = 1; k < s_.count; ++k)
      if (work_.changed[k]) set_terms_of(k);
  }

  /// Whether some joint of the robots `which` has reached another piece of its law than the one that was tried. That
  /// piece is tried next.
  bool look_again(unsigned which) {
    constexpr unsigned all = lane::all_lanes<S>;
    unsigned changed = 0;
    for (int k = 1; k < s_.count; ++k) {
      if (s_.joints[k].leader >= 0) continue;
      const BodyStep<S>& b = work_.bodies[k];
      JointPiece<S>& tried = work_.pieces[k];
      const JointLaw<S> law = this->law(k);
      const S sign(s_.bodies[k].sign), v = start_of(k).velocity;
      MaskOf<S> stays;
      if (!law.holds_velocity) {
        const S after = v + sign * S(batch_.dt) * b.qdd;
        stays = goes_on(law, tried, after);
        tried.effort = law.pull - law.drag * after;
        if (lane::bits(stays) == all) continue;
      }
      const S inertia = moved_inertia(s_.bodies[k], b) + armature_of(k);
      const S load = sign * (b.needed + b.terms.effort), needed = load + sign * inertia * b.qdd;
      if (law.holds_velocity) {
        tried.effort = tracking_effort_of(law, needed + law.damping * law.velocity);
        stays = tracks(law, tried, tried.effort);
      } else {
        const auto rests = stays_at_rest(law, tried, needed);
        tried.effort = select(rests, clamp(law.pull, -law.effort, law.effort), tried.effort);
        stays = stays | rests;
      }
      if (lane::bits(stays) == all) continue;
      const JointPiece<S> found = meet(law, inertia, v - S(batch_.dt) * load / inertia, batch_.dt);
      const auto same = stays | (tried == found);
      // from its second change on, a joint is tried as a damper
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
      work_.changed[k] = work_.changed[k] || lane::bits(!settled) != 0;
      const S effort = select(stays, tried.effort, found.effort);
      tried = chosen(settled, tried, next);
      tried.effort = effort;
    }
    return (changed & which) != 0;
  }

  /// Moves joints by semi-implicit Euler; carried joints of the robots `which` move with the mean of both velocities.
  /// Keeps the motion within the step (JointStage). Returns those of `which` in which no joint was stopped at once.
  MaskOf<S> move(MaskOf<S> which) {
    const S h(batch_.dt), hardly(1e-4);  // rad/s or m/s
    const bool some = lane::bits(which) != 0;
    MaskOf<S> is_smooth = which;
    for (int k = 1; k < s_.count; ++k) {
      const Joint& joint = s_.joints[k];
      BodyStep<S>& b = work_.bodies[k];
      JointStage<S>& j = work_.stages[k];
      b.qd = j.qd + h * b.qdd;
      b.q = j.q + h * b.qd;
      j.velocities = b.qd;
      if (!some) continue;
      if (is_carried(joint)) carry(k, which);
      if (may_stop(joint)) is_smooth = is_smooth & ((b.terms.is_free > S(0)) | (abs(b.qd - j.qd) < hardly));
    }
    finish();
    for (int k = 1; s_.has_mimics && k < s_.count; ++k)
      if (const int leader = s_.joints[k].leader; leader >= 0)
        work_.stages[k].velocities = factor_of<S>(s_, k) * work_.stages[leader].velocities;
    return is_smooth;
  }
  /// Ends the motion of joints: mimic joints follow.
  void finish() {
    if (s_.has_mimics) follow_leaders(s_, work_, S(0) == S(0));
  }

  void store(unsigned which) const {
    each_row([&]<int n>(int k, std::integral_constant<int, n>) {
      S q[n], qd[n], effort[n];
      for (int i = 0; i < n; ++i) {
        const S sign(s_.bodies[k + i].sign);
        q[i] = sign * work_.bodies[k + i].q, qd[i] = sign * work_.bodies[k + i].qd;
        effort[i] = work_.pieces[k + i].effort;
      }
      store_numbers(positions_, s_.joints[k].position, q, which);
      store_numbers(velocities_, s_.joints[k].velocity, qd, which);
      store_numbers(efforts_, s_.joints[k].out_effort, effort, which);
    });
  }
  S sum() const {
    S all(0);
    for (int k = 1; k < s_.count; ++k) all += abs(work_.bodies[k].q) + abs(work_.bodies[k].qd);
    return all;
  }
  /// Keeps for the next step the accelerations of carried joints in the robots `smooth` (zeros in the others), and
  /// which drives of velocity are at their limit. [after move]
  void keep_accelerations(MaskOf<S> smooth, unsigned which) const {
    each_row([&]<int n>(int k, std::integral_constant<int, n>) {
      if (!keeps_something(k, n)) return;
      S of_joints[n];
      for (int i = 0; i < n; ++i) {
        const Joint& j = s_.joints[k + i];
        of_joints[i] = is_carried(j)       ? select(smooth, work_.stages[k + i].accelerations, S(0))
                       : holds_velocity(j) ? bound_of(work_.pieces[k + i], S(j.effort))
                                           : S(0);
      }
      store_numbers(accelerations_, of_base + k - 1, of_joints, which);
    });
  }

 private:
  static constexpr int of_base = 6;  ///< number of accelerations before those of joints

  /// Calls f(k, n) for joints k to k + n - 1, whose numbers lie side by side, until all are visited.
  template <class F>
  MURO_INLINE void each_row(const F& f) const {
    int k = 1;
    for (; s_.lie_side_by_side && k + 4 <= s_.count; k += 4) f(k, std::integral_constant<int, 4>());
    for (; k < s_.count; ++k) f(k, std::integral_constant<int, 1>());
  }

  struct State {
    S position, velocity;
  };
  /// State of a joint at the start, in the direction of the model.
  MURO_INLINE State start_of(int k) const {
    const S sign(s_.bodies[k].sign);
    return {sign * work_.stages[k].q, sign * work_.stages[k].qd};
  }

  /// Whether a joint is carried: its velocity moves it, and an effort that does not depend on its position.
  MURO_INLINE static bool is_carried(const Joint& j) {
    return j.leader < 0 && (j.drive == Drive::effort || j.drive == Drive::passive);
  }
  bool has_carried(int k, int n) const {
    return std::any_of(s_.joints + k, s_.joints + k + n, [](const Joint& j) { return is_carried(j); });
  }

  bool keeps_something(int k, int n) const {
    return std::any_of(s_.joints + k, s_.joints + k + n,
                       [](const Joint& j) { return is_carried(j) || holds_velocity(j); });
  }
  /// Returns -1 or 1 for a drive that gives its largest effort, `most`, and lets the joint go; else 0.
  MURO_INLINE static S bound_of(const JointPiece<S>& piece, S most) {
    return select((piece.is_free > S(0)) & (abs(piece.effort) >= most), sign_of(piece.effort), S(0));
  }

  /// Whether something can stop or hold the joint at once.
  MURO_INLINE static bool may_stop(const Joint& j) {
    return j.lower > -Joint::infinite || j.upper < Joint::infinite || j.friction > 0 || j.has_friction_loss ||
           (j.drive == Drive::position && j.speed < Joint::infinite);
  }

  /// Corrects a joint that has moved by semi-implicit Euler.
  MURO_INLINE void carry(int k, MaskOf<S> which) {
    BodyStep<S>& b = work_.bodies[k];
    JointStage<S>& j = work_.stages[k];
    const auto mean_moves = which & (b.terms.is_free > S(0));
    const S mean = S(0.5) * (j.qd + b.qd);
    b.q = select(mean_moves, within_stops(k, j.q + S(batch_.dt) * mean, b.q), b.q);
    j.velocities = select(mean_moves, mean, b.qd);
    j.accelerations = select(mean_moves, trend<S>(b.qdd, j.accelerations), S(0));
  }
  /// Returns `q` (rad or m), but no farther beyond a stop than `end`, to which the law of the joint has brought it.
  MURO_INLINE S within_stops(int k, S q, S end) const {
    const Joint& j = s_.joints[k];
    const bool turned = s_.bodies[k].sign < 0;
    const double lowest = turned ? -j.upper : j.lower, highest = turned ? -j.lower : j.upper;
    if (lowest > -Joint::infinite) q = max(q, min(end, S(lowest)));
    if (highest < Joint::infinite) q = min(q, max(end, S(highest)));
    return q;
  }

  /// Returns `a` in the robots `m` and else `b`; the effort is that of `b`.
  MURO_INLINE static JointPiece<S> chosen(MaskOf<S> m, const JointPiece<S>& a, const JointPiece<S>& b) {
    return {select(m, a.is_free, b.is_free), select(m, a.pull, b.pull), select(m, a.drag, b.drag),
            select(m, a.velocity, b.velocity), b.effort};
  }

  /// Returns the velocity (rad/s or m/s) at which a joint at `q` would reach its stop at the end of the step. A joint
  /// beyond the stop comes back over some steps.
  MURO_INLINE S velocity_to(double stop, S q, double side) const {
    constexpr double part = 0.05;
    const S away = S(stop) - q;
    return away * select(S(side) * away < S(0), S(part / batch_.dt), S(1 / batch_.dt));
  }

  void set_terms_of(int k) {
    JointTerms<S> t = terms_of(work_.pieces[k], armature_of(k), start_of(k).velocity, batch_.dt);
    t.effort *= S(s_.bodies[k].sign), t.rate *= S(s_.bodies[k].sign);
    work_.bodies[k].terms = t;
  }

  MURO_INLINE static bool holds_velocity(const Joint& j) {
    return j.leader < 0 && (j.drive == Drive::velocity || j.drive == Drive::acceleration);
  }

  /// Returns the law that find_law() found.
  MURO_INLINE JointLaw<S> law(int k) const {
    const Joint& j = s_.joints[k];
    const OwnLaw<S>& own = work_.laws[k];
    const S zero(0), infinite(Joint::infinite);
    JointLaw<S> law{zero, zero, zero, S(j.effort), S(j.damping), S(j.friction), -infinite, infinite, j.speed, false};
    if (j.lower > -Joint::infinite) law.lowest = own.lowest;
    if (j.upper < Joint::infinite) law.highest = own.highest;
    if (j.has_friction_loss) law.friction += own.friction_loss;
    if (j.drive == Drive::passive || j.leader >= 0) return law;
    law.holds_velocity = holds_velocity(j);
    (law.holds_velocity ? law.velocity : law.pull) = own.pull;
    if (j.drive == Drive::position)
      law.drag = j.needs_inertia() ? own.drag : S(j.drive_damping + batch_.dt * j.stiffness);
    return law;
  }

  void find_law(int k) {
    const Joint& j = s_.joints[k];
    const State state = start_of(k);
    const S speed(j.speed), effort(j.effort);
    OwnLaw<S>& own = work_.laws[k];
    if (j.lower > -Joint::infinite) own.lowest = velocity_to(j.lower, state.position, -1);
    if (j.upper < Joint::infinite) own.highest = velocity_to(j.upper, state.position, 1);
    if (j.leader >= 0) return;
    if (j.has_friction_loss) own.friction_loss = load<S>(friction_losses_, j.friction_loss);
    if (j.has_armature_loss) own.armature_loss = load<S>(armature_losses_, j.armature_loss);
    if (j.drive == Drive::passive) return;
    if (holds_velocity(j)) own.bound = accelerations_.at[0] ? load<S>(as_read(accelerations_), of_base + k - 1) : S(0);
    const S target = load<S>(targets_[int(j.drive)], j.target);
    if (j.drive == Drive::position)
      drive_to(k, target, state, own);
    else if (j.drive == Drive::effort)
      own.pull = clamp(target, -effort, effort);
    else if (j.drive == Drive::velocity)
      own.pull = clamp(target, -speed, speed);
    else
      own.pull = clamp(state.velocity + S(batch_.dt) * target, -speed, speed);
  }

  /// Sets a PD controller with position and velocity of the end of the step: kp (target - q - h v') + kd (target
  /// velocity - v').
  MURO_INLINE void drive_to(int k, S target, const State& state, OwnLaw<S>& own) {
    const Joint& j = s_.joints[k];
    S stiffness(j.stiffness), damping(j.drive_damping);
    if (j.needs_inertia()) {
      const S inertia = work_.bodies[k].D + armature_of(k), w(j.natural_frequency);  // see find_moved_inertias
      if (j.stiffness < 0) stiffness = w * w * inertia;
      if (j.drive_damping < 0) damping = S(2) * lane::sqrt(stiffness * inertia);
      own.drag = damping + S(batch_.dt) * stiffness;
    }
    const S allowed = clamp(target, S(j.lower), S(j.upper)), speed(j.speed);
    own.pull = stiffness * (allowed - state.position);
    if (!j.has_target_velocity) return;
    const S velocity = clamp(load<S>(targets_[int(Drive::velocity)], j.target_velocity), -speed, speed);
    own.pull += damping * select(allowed == target, velocity, S(0));
  }

  const Batch& batch_;
  const Structure& s_;
  Work<S>& work_;
  lane::Places<S, double> positions_, velocities_, efforts_, accelerations_;
  lane::Places<S> targets_[target_kinds], friction_losses_, armature_losses_;
};

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
