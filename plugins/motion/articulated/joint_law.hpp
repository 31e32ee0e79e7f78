// SPDX-License-Identifier: MIT
// Efforts along a joint beside the bodies behind it: its drive, damping, Coulomb friction and stops. Their sum is a
// function of the velocity at the end of the step that never rises. It has jumps: friction at rest, a drive that holds
// a velocity within its effort, stops. A step takes a straight piece of it, or holds the joint at a jump, and checks
// afterwards whether the joint has reached that piece.
#pragma once

#include "dynamics.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

using lane::abs, lane::MaskOf, lane::max, lane::min, lane::select;

/// Law of a joint in one step.
template <class S>
struct JointLaw {
  S pull, drag;         ///< N m or N, N m s/rad or N s/m: of the drive; its effort is pull - drag v'
  S velocity;           ///< rad/s or m/s: velocity that a drive holds
  S effort;             ///< N m or N: largest effort of the drive
  S damping;            ///< N m s/rad or N s/m
  S friction;           ///< N m or N
  S lowest, highest;    ///< rad/s or m/s: velocities at which the joint would meet a stop at the end of the step
  double speed;         ///< rad/s or m/s: largest speed of the drive
  bool holds_velocity;  ///< the drive holds a velocity
};

/// Numbers of the law of a joint that differ between robots of one structure. A number that the Joint does not need is
/// not set.
template <class S>
struct OwnLaw {
  S pull;             ///< pull, or the velocity of a drive that holds one
  S lowest, highest;  ///< for joints with stops
  S drag;             ///< for drives whose damping follows from the inertia
  S friction_loss, armature_loss;
  S bound;  ///< -1, 1: a drive that holds a velocity gave its largest effort in the last step; else 0
};

/// Piece of a law that a step takes.
template <class S>
struct JointPiece {
  S is_free;     ///< 1; 0: held at `velocity`
  S pull, drag;  ///< the effort along the joint is pull - drag v'
  S velocity;    ///< rad/s or m/s: at the end of the step
  S effort;      ///< N m or N: effort of the drive

  MURO_INLINE friend MaskOf<S> operator==(const JointPiece& a, const JointPiece& b) {
    const auto same_hold = (a.is_free == S(0)) & (b.is_free == S(0)) & (a.velocity == b.velocity);
    return same_hold | ((a.is_free == S(1)) & (b.is_free == S(1)) & (a.pull == b.pull) & (a.drag == b.drag));
  }
};

template <class S>
MURO_INLINE S clamp(S x, S low, S high) {
  return max(low, min(high, x));
}
template <class S>
MURO_INLINE S sign_of(S x) {
  return select(x < S(0), S(-1), S(1));
}

/// Returns the effort (N m or N) by which a drive reaches its held velocity in a step; this takes `needed` beside
/// friction.
template <class S>
MURO_INLINE S tracking_effort_of(const JointLaw<S>& law, S needed) {
  const S zero(0), at_rest = sign_of(needed) * max(abs(needed) - law.friction, zero);
  return select(law.velocity == zero, at_rest, needed + sign_of(law.velocity) * law.friction);
}

/// Finds the piece on which a joint ends in a step of `dt` (s). Without the law the joint has the velocity `free`
/// (rad/s or m/s); an impulse changes it by 1 / `inertia` (kg m^2 or kg).
template <class S>
MURO_INLINE JointPiece<S> meet(const JointLaw<S>& law, S inertia, S free, double dt) {
  const S zero(0), one(1), per_second = inertia * S(1 / dt), push = per_second * free;
  S pull = law.pull, drag = law.drag;
  auto tracks = zero > one;
  S tracking_effort = zero;
  if (law.holds_velocity) {
    tracking_effort = tracking_effort_of(law, (per_second + law.damping) * law.velocity - push);
    tracks = abs(tracking_effort) <= law.effort;
    pull = clamp(tracking_effort, -law.effort, law.effort);
    drag = zero;
  }
  const S start = clamp(pull, -law.effort, law.effort) + push;
  const auto sticks = (law.friction > zero) & (abs(start) <= law.friction);
  const S side = sign_of(start), friction = side * law.friction, rest = push - friction;
  const S within = (rest + pull) / (per_second + drag + law.damping), wanted = pull - drag * within;
  const auto is_weak = abs(wanted) > law.effort;
  pull = select(is_weak, sign_of(wanted) * law.effort, pull);
  drag = select(is_weak, zero, drag);
  S v = select(is_weak, (rest + pull) / (per_second + law.damping), within);
  auto held = sticks;
  v = select(sticks, zero, v);
  S effort = pull - drag * v;
  if (law.speed < Joint::infinite && !law.holds_velocity) {
    const S speed(law.speed), without = rest / (per_second + law.damping);
    const auto is_fast = (abs(v) > speed) & (effort * v > zero);
    const auto coasts = is_fast & (abs(without) >= speed), stays = is_fast & !coasts;
    v = select(stays, side * speed, select(coasts, without, v));
    pull = select(coasts, zero, pull), drag = select(coasts, zero, drag);
    held = held | stays;
    effort = select(stays, (per_second + law.damping) * v - rest, select(coasts, zero, effort));
  }
  v = select(tracks, law.velocity, v);
  effort = select(tracks, tracking_effort, effort);
  held = held | tracks;
  const auto stops = (v > law.highest) | (v < law.lowest);
  v = clamp(v, law.lowest, law.highest);
  const S at_stop = law.holds_velocity ? effort : clamp(law.pull - law.drag * v, -law.effort, law.effort);
  held = held | stops;
  return {select(held, zero, one), pull - friction, drag + law.damping, v, select(stops, at_stop, effort)};
}

/// Returns the piece on which a joint with velocity `v` most probably ends: its present one, or rest if it hardly moves
/// and friction may hold it. `bound`: see OwnLaw; for a drive that holds a velocity.
template <class S>
MURO_INLINE JointPiece<S> guess(const JointLaw<S>& law, S v, S bound) {
  const S zero(0), one(1), hardly(1e-4);  // rad/s or m/s
  if (law.holds_velocity) {
    const MaskOf<S> gives_way = (bound > zero) | (bound < zero);
    const S pull = bound * law.effort - sign_of(v) * law.friction;
    return {select(gives_way, one, zero), select(gives_way, pull, zero), select(gives_way, law.damping, zero),
            clamp(law.velocity, law.lowest, law.highest), zero};
  }
  const S friction = sign_of(v) * law.friction, wanted = law.pull - law.drag * v;
  const auto is_weak = abs(wanted) > law.effort;
  const S pull = select(is_weak, sign_of(wanted) * law.effort, law.pull), drag = select(is_weak, zero, law.drag);
  const auto sticks = (abs(v) < hardly) & (law.friction > zero);
  const auto stops = (v >= law.highest) | (v <= law.lowest);
  const S to = clamp(select(sticks, zero, v), law.lowest, law.highest);
  return {select(sticks | stops, zero, one), pull - friction, drag + law.damping, to, zero};
}

/// Returns a piece for joints that push each other from piece to piece. Drive and friction are dampers, which do at the
/// velocity `v` what the law does there. Against a motion they can do no more than the law.
template <class S>
MURO_INLINE JointPiece<S> damped(const JointLaw<S>& law, const JointPiece<S>& found, S v) {
  const S zero(0), one(1), tiny(1e-9);
  S pull = law.pull, drag = law.drag;
  auto held = zero > one;
  if (law.holds_velocity) {
    held = law.effort == S(Joint::infinite);
    drag = select(MaskOf<S>(held), zero, law.effort / max(abs(law.velocity - v), tiny));
    pull = drag * law.velocity;
  }
  const S part = min(one, law.effort / max(abs(pull - drag * v), tiny));
  const auto stops = (v >= law.highest) | (v <= law.lowest);
  held = held | stops;
  const S to = clamp(law.holds_velocity ? law.velocity : v, law.lowest, law.highest);
  return {select(held, zero, one), part * pull, part * drag + law.damping + law.friction / max(abs(v), S(1e-6)), to,
          found.effort};
}
/// Whether two such pieces are about the same.
template <class S>
MURO_INLINE MaskOf<S> are_alike(const JointPiece<S>& a, const JointPiece<S>& b) {
  return (a.is_free == b.is_free) & (abs(a.drag - b.drag) <= S(0.1) * max(a.drag, b.drag));
}

/// Whether a joint that ends with the velocity `v` is on the piece that was tried, as most are: a drive within its
/// limits moves it, and neither friction nor a stop holds it.
template <class S>
MURO_INLINE MaskOf<S> goes_on(const JointLaw<S>& law, const JointPiece<S>& tried, S v) {
  const S zero(0);
  const auto is_this_piece = (tried.is_free > zero) & (tried.drag == law.drag + law.damping) &
                             (tried.pull == law.pull - sign_of(v) * law.friction);
  return is_this_piece & (abs(law.pull - law.drag * v) <= law.effort) & (abs(v) <= S(law.speed)) & (v < law.highest) &
         (v > law.lowest);
}

/// Whether a drive that was tried at the velocity that it holds needs an `effort` within its limit, as most do.
template <class S>
MURO_INLINE MaskOf<S> tracks(const JointLaw<S>& law, const JointPiece<S>& tried, S effort) {
  return (tried.is_free == S(0)) & (tried.velocity == law.velocity) & (abs(effort) <= law.effort);
}

/// Whether friction that was tried to hold a joint at rest does so. `needed` (N m or N): effort along the joint that
/// this takes.
template <class S>
MURO_INLINE MaskOf<S> stays_at_rest(const JointLaw<S>& law, const JointPiece<S>& tried, S needed) {
  const S zero(0);
  const S drive = clamp(law.pull, -law.effort, law.effort);
  return (tried.is_free == zero) & (tried.velocity == zero) & (law.friction > zero) & (law.lowest < zero) &
         (law.highest > zero) & (abs(needed - drive) <= law.friction);
}

/// Returns the terms of a piece for the algorithm. `armature`: kg m^2 or kg; `v`: at the begin of the step.
template <class S>
MURO_INLINE JointTerms<S> terms_of(const JointPiece<S>& piece, S armature, S v, double dt) {
  const S zero(0), h(dt);
  const auto held = piece.is_free == zero;
  return {select(held, zero, piece.pull - piece.drag * v), armature + select(held, zero, h * piece.drag),
          select(held, (piece.velocity - v) * S(1 / dt), zero), piece.is_free};
}

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
