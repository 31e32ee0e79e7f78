// SPDX-License-Identifier: MIT
// Motion of a joint that follows its target within limits of speed and acceleration, over a double or a lane of robots.
// Each function advances one joint by `dt` (s) with constant acceleration; positions in rad or m.
#pragma once

#include <type_traits>

#include "move.hpp"
#include "muro/simd/lane.hpp"

namespace muro::simplified::joints {
inline namespace MURO_ISA {

using lane::abs, lane::any, lane::MaskOf, lane::max, lane::min, lane::select, lane::sqrt;

template <class S>
struct JointState {
  S position;
  S velocity;
};

/// Clamps `x`; NaN stays NaN. low <= high.
template <class S>
MURO_INLINE S clamp(S x, S low, S high) {
  return max(low, min(high, x));
}
constexpr bool is_finite(double limit) { return -JointRange::infinite < limit && limit < JointRange::infinite; }

/// Returns the largest velocity u at the end of a step from which the joint can still stop at `distance`. The step
/// begins with `v`; both are towards the goal. It solves (v + u) dt/2 + u^2 / (2 a) = distance. Negative when the joint
/// must turn back.
template <class S>
MURO_INLINE S braking_velocity(S distance, S v, double a, double dt) {
  const S remaining = distance - S(0.5) * v * S(dt);
  const S root = sqrt(max(S(0.25 * dt * dt) + S(2) * remaining / S(a), S(0)));
  return S(2) * remaining / (S(0.5 * dt) + root);
}

/// Whether a joint can come to rest at `distance` >= 0 within `dt`, by speeding up to sqrt(a d + v^2/2) and then
/// braking. The margin absorbs round-off in `distance`.
template <class S>
MURO_INLINE MaskOf<S> can_stop_at(S distance, S v, S speed, double a, double dt) {
  const S margin(1e-6 * (a * dt) * (a * dt));
  return (v >= S(0)) & (v * v - S(2 * a) * distance <= margin) & (distance <= speed * S(dt)) &
         (S(2) * sqrt(S(a) * distance + S(0.5) * v * v) - v <= S(a * dt * (1 + 1e-6)));
}

/// Advances the joint with the velocity `u` at the end of the step; it stops at once at a limit.
template <class S>
MURO_INLINE JointState<S> integrate(const JointState<S>& joint, S u, const JointRange& range, double dt) {
  const S q = joint.position + (joint.velocity + u) * S(0.5 * dt);
  if (!is_finite(range.lower) && !is_finite(range.upper)) return {q, u};
  const S position = clamp(q, S(range.lower), S(range.upper));
  return {position, select(position == q, u, S(0))};
}

/// Moves the joint to `goal` no faster than `speed`, and stops there without overshoot.
template <class S>
MURO_INLINE JointState<S> move_towards(const JointState<S>& joint, S goal, S speed, const JointRange& range,
                                       double dt) {
  const S offset = goal - joint.position, sign = select(offset < S(0), S(-1), S(1));
  const S distance = sign * offset, v = sign * joint.velocity, change(range.acceleration * dt);
  const S u = min(speed, braking_velocity(distance, v, range.acceleration, dt));
  // Braking may exceed the limit slightly, so that round-off of many steps does not make the joint too fast to stop.
  const S allowed = sign * clamp(u, v - change * S(1 + 1e-6), v + change);
  const JointState<S> on = integrate(joint, allowed, range, dt);
  const auto stops = can_stop_at(distance, v, speed, range.acceleration, dt);
  return {select(stops, goal, on.position), select(stops, S(0), on.velocity)};
}

/// Moves the joint in position mode.
template <class S>
MURO_INLINE void follow_position(JointState<S>& joint, std::type_identity_t<S> target, const JointRange& range,
                                 double dt) {
  joint = move_towards(joint, clamp(target, S(range.lower), S(range.upper)), S(range.speed), range, dt);
}

/// Moves the joint in velocity mode: changes the velocity as fast as allowed, and stops at the position limits.
template <class S>
MURO_INLINE void follow_velocity(JointState<S>& joint, std::type_identity_t<S> target, const JointRange& range,
                                 double dt) {
  const S velocity = clamp(target, S(-range.speed), S(range.speed)), change(range.acceleration * dt);
  JointState<S> next = integrate(joint, clamp(velocity, joint.velocity - change, joint.velocity + change), range, dt);
  const auto towards = [&](double limit, MaskOf<S> those) {
    if (!is_finite(limit)) return;
    const JointState<S> there = move_towards(joint, S(limit), abs(velocity), range, dt);
    next = {select(those, there.position, next.position), select(those, there.velocity, next.velocity)};
  };
  towards(range.upper, velocity > S(0));
  towards(range.lower, velocity < S(0));
  joint = next;
}

/// Moves the joint in acceleration mode.
template <class S>
MURO_INLINE void follow_acceleration(JointState<S>& joint, std::type_identity_t<S> target, const JointRange& range,
                                     double dt) {
  const S a = clamp(target, S(-range.acceleration), S(range.acceleration));
  const S change(range.acceleration * dt), v = joint.velocity;
  S u = clamp(v + a * S(dt), S(-range.speed), S(range.speed));
  if (is_finite(range.upper)) {
    const S max_velocity = max(braking_velocity(S(range.upper) - joint.position, v, range.acceleration, dt), S(0));
    u = select(u > S(0), min(u, max_velocity), u);
  }
  if (is_finite(range.lower)) {
    const S max_velocity = max(braking_velocity(joint.position - S(range.lower), -v, range.acceleration, dt), S(0));
    u = select(u < S(0), max(u, -max_velocity), u);
  }
  joint = integrate(joint, clamp(u, v - change, v + change), range, dt);
}

}  // namespace MURO_ISA
}  // namespace muro::simplified::joints
