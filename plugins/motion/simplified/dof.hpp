// SPDX-License-Identifier: MIT
// A joint that forces move: one degree of freedom with damping, Coulomb friction and stops.
#pragma once

#include <algorithm>
#include <cmath>

#include "joint_motion.hpp"
#include "muro/robot.hpp"
#include "plugins/motion/common/position_drive/position_drive.hpp"

namespace muro::simplified {

using DofState = joints::JointState<double>;

/// Returns the part of `force` (N m or N) above `friction` >= 0, the largest force that friction holds.
inline double beyond_friction(double force, double friction) {
  return force > 0 ? std::max(force - friction, 0.0) : std::min(force + friction, 0.0);
}

/// Advances the state by `dt` (s) with the velocity `v` at its end; stops are inelastic.
inline DofState moved_on(const DofState& s, double v, const JointLimits& limits, double dt) {
  const double q = s.position + (s.velocity + v) * (0.5 * dt);
  const double position = std::clamp(q, limits.lower, limits.upper);
  return {position, position == q ? v : 0};
}

/// Returns the velocity after `dt` (s) under the constant `force` (N m or N): inertia v' = force - damping v -
/// friction. Damping and friction belong to the end of the step. Friction never exceeds the force that stops the joint,
/// so a joint comes to rest and stays there. `inertia` > 0: kg m^2 or kg.
inline double velocity_under(const DofState& s, double force, double inertia, const JointLimits& limits, double dt) {
  const double momentum = beyond_friction(inertia * s.velocity + force * dt, limits.friction * dt);
  return momentum / (inertia + limits.damping * dt);
}

/// Advances the state by `dt` (s) under the constant `force` with velocity_under(), without a speed limit. Stops are
/// inelastic. Position: q' = q + (v + v') dt/2, exact for a constant force.
inline DofState integrate_force(const DofState& s, double force, double inertia, const JointLimits& limits, double dt) {
  return moved_on(s, velocity_under(s, force, inertia, limits, dt), limits, dt);
}

/// Returns the drive's effort that brings a joint from velocity `from` to `to` within `dt`, under `load` (all other
/// forces, N m or N). It is the inverse of integrate_force(). For `to` = 0 it is only the part that friction does not
/// hold.
inline double inverse_dynamics(double from, double to, double load, double inertia, const JointLimits& limits,
                               double dt) {
  const double needed = ((inertia + limits.damping * dt) * to - inertia * from) / dt - load;
  return to == 0 ? beyond_friction(needed, limits.friction) : needed + std::copysign(limits.friction, to);
}

/// Advances the state by `dt` (s) under the effort of a drive and `load` (all other forces, N m or N). The drive pushes
/// the joint no faster than its speed limit; a load may, and then the drive does nothing. `effort`: in and out, N m or
/// N.
inline DofState integrate_effort(const DofState& s, double& effort, double load, double inertia,
                                 const JointLimits& limits, double dt) {
  double v = velocity_under(s, effort + load, inertia, limits, dt);
  if (std::abs(v) > limits.velocity && effort * v > 0) {
    const double fastest = std::copysign(limits.velocity, v), coasting = velocity_under(s, load, inertia, limits, dt);
    const bool coasts = coasting * fastest >= fastest * fastest;
    v = coasts ? coasting : fastest;
    effort = coasts ? 0 : inverse_dynamics(s.velocity, v, load, inertia, limits, dt);
  }
  return moved_on(s, v, limits, dt);
}

/// Advances a joint with its own target like integrate_effort(), but a load cannot exceed the speed limit either. Limbs
/// do not push the base back in this model, so contacts could give a light limb an unlimited speed.
inline DofState integrate_weak_drive(const DofState& s, double& effort, double load, double inertia,
                                     const JointLimits& limits, double dt) {
  const DofState free = integrate_effort(s, effort, load, inertia, limits, dt);
  if (std::abs(free.velocity) <= limits.velocity) return free;
  return moved_on(s, std::copysign(limits.velocity, free.velocity), limits, dt);
}

/// Advances the state by `dt` (s) with a PD drive, no stronger than the effort limit, under `load` (all other forces, N
/// m or N). `effort`: out, effort of the drive at the end of the step, N m or N.
inline DofState follow_drive(const DofState& s, const ImplicitDrive& drive, double load, double inertia,
                             const JointLimits& limits, double dt, double& effort) {
  const double momentum =
      beyond_friction(inertia * s.velocity + (drive.damping * drive.velocity + load) * dt, limits.friction * dt);
  const double v = momentum / (inertia + (limits.damping + drive.damping) * dt);
  effort = drive.effort(v);
  const bool is_fast = std::abs(v) > limits.velocity && effort * v > 0;
  if (std::abs(effort) <= limits.effort && !is_fast && std::abs(v) <= limits.velocity)
    return moved_on(s, v, limits, dt);
  effort = std::clamp(effort, -limits.effort, limits.effort);
  return integrate_weak_drive(s, effort, load, inertia, limits, dt);
}

/// A drive that follows its target as long as its effort suffices.
struct Drive {
  Mode mode = Mode::velocity;
  double target = 0;            ///< target of the mode
  double max_acceleration = 0;  ///< rad/s^2 or m/s^2
};

/// Follows the drive's target, no stronger than the effort limit: a load that is too heavy moves the joint. `effort`:
/// out, effort of the drive, N m or N.
inline DofState follow_target(const DofState& s, const Drive& drive, double load, double inertia,
                              const JointLimits& limits, double dt, double& effort) {
  const JointRange range{limits.lower, limits.upper, limits.velocity,
                         std::min(drive.max_acceleration, limits.effort / inertia)};
  DofState wanted = s;
  if (drive.mode == Mode::velocity)
    joints::follow_velocity(wanted, drive.target, range, dt);
  else if (drive.mode == Mode::position)
    joints::follow_position(wanted, drive.target, range, dt);
  else
    joints::follow_acceleration(wanted, drive.target, range, dt);
  const double needed = inverse_dynamics(s.velocity, wanted.velocity, load, inertia, limits, dt);
  effort = std::clamp(needed, -limits.effort, limits.effort);
  return effort == needed ? wanted : integrate_weak_drive(s, effort, load, inertia, limits, dt);
}

}  // namespace muro::simplified
