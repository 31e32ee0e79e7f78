// SPDX-License-Identifier: MIT
// How a joint follows its target within limits of speed and acceleration. Each function advances one joint
// by `dt` (s) with constant acceleration; positions in rad or m.
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

namespace muro::simplified {

struct JointState {
  double position = 0;
  double velocity = 0;
};

struct JointRange {
  double lower = -std::numeric_limits<double>::infinity();
  double upper = std::numeric_limits<double>::infinity();
  double speed = std::numeric_limits<double>::infinity();
  double acceleration = 1e9;
};

/// The velocity u at the end of a step that begins with `v`, both towards a goal at `distance`, from which the
/// joint can still stop there: (v + u) dt/2 + u^2 / (2 a) = distance. Negative when it must turn back.
inline double braking_velocity(double distance, double v, double a, double dt) {
  const double room = distance - 0.5 * v * dt;
  const double root = std::sqrt(std::max(0.0, 0.25 * dt * dt + 2 * room / a));
  return 2 * room / (0.5 * dt + root);
}

/// Whether a joint can be at rest at `distance` >= 0 within `dt`: speeding up to sqrt(a d + v^2/2), then braking.
/// The margin absorbs round-off in `distance`.
inline bool arrives(double distance, double v, const JointRange& range, double dt) {
  const double a = range.acceleration, margin = 1e-6 * (a * dt) * (a * dt);
  return v >= 0 && v * v - 2 * a * distance <= margin && distance <= range.speed * dt &&
         2 * std::sqrt(a * distance + 0.5 * v * v) - v <= a * dt * (1 + 1e-6);
}

/// Moves on with the velocity `u` at the end of the step; stops dead at a limit.
inline void move_on(JointState& joint, double u, const JointRange& range, double dt) {
  const double q = joint.position + 0.5 * (joint.velocity + u) * dt;
  joint.position = std::clamp(q, range.lower, range.upper);
  joint.velocity = joint.position == q ? u : 0;
}

/// Goes to `goal` no faster than `speed`, and stops there without overshoot.
inline void go_to(JointState& joint, double goal, double speed, const JointRange& range, double dt) {
  const double way = goal - joint.position, sign = way < 0 ? -1 : 1;
  const double distance = sign * way, v = sign * joint.velocity, change = range.acceleration * dt;
  JointRange limited = range;
  limited.speed = speed;
  if (arrives(distance, v, limited, dt)) {
    joint = {goal, 0};
    return;
  }
  const double u = std::min(speed, braking_velocity(distance, v, range.acceleration, dt));
  // Braking may exceed the limit by a hair, so that round-off of many steps does not make the joint too fast to stop.
  move_on(joint, sign * std::clamp(u, v - change * (1 + 1e-6), v + change), range, dt);
}

/// Position mode.
inline void follow_position(JointState& joint, double target, const JointRange& range, double dt) {
  go_to(joint, std::clamp(target, range.lower, range.upper), range.speed, range, dt);
}

/// Velocity mode: takes the velocity on as fast as allowed, and stops at the limits of position.
inline void follow_velocity(JointState& joint, double target, const JointRange& range, double dt) {
  const double wanted = std::clamp(target, -range.speed, range.speed), change = range.acceleration * dt;
  const double limit = wanted > 0 ? range.upper : range.lower;
  if (wanted != 0 && std::isfinite(limit)) return go_to(joint, limit, std::abs(wanted), range, dt);
  move_on(joint, std::clamp(wanted, joint.velocity - change, joint.velocity + change), range, dt);
}

/// Acceleration mode.
inline void follow_acceleration(JointState& joint, double target, const JointRange& range, double dt) {
  const double a = std::clamp(target, -range.acceleration, range.acceleration);
  const double change = range.acceleration * dt, v = joint.velocity;
  double u = std::clamp(v + a * dt, -range.speed, range.speed);
  const double up = range.upper - joint.position, down = joint.position - range.lower;
  if (u > 0 && std::isfinite(up)) u = std::min(u, std::max(0.0, braking_velocity(up, v, range.acceleration, dt)));
  if (u < 0 && std::isfinite(down)) u = std::max(u, std::min(0.0, -braking_velocity(down, -v, range.acceleration, dt)));
  move_on(joint, std::clamp(u, v - change, v + change), range, dt);
}

}  // namespace muro::simplified
