// SPDX-License-Identifier: MIT
#include "joint_drive_target.hpp"

#include <algorithm>
#include <cmath>

namespace muro::multibody {

DriveTarget drive_target_of(const RigidBody& body, const JointState& joint, const JointState* leader,
                            const double* target, double gain_of_mimics) {
  const JointLimits& limits = body.limits;
  DriveTarget t;
  t.max_effort = limits.effort;
  if (leader) {
    t.tracks_velocity = true;
    t.velocity = body.multiplier * leader->velocity +
                 gain_of_mimics * (body.offset + body.multiplier * leader->position - joint.position);
    return t;
  }
  if (body.drive != DriveMode::velocity) t.friction = limits.friction;
  switch (body.drive) {
    case DriveMode::velocity:
      t.tracks_velocity = true;
      t.velocity = std::clamp(*target, -limits.velocity, limits.velocity);
      break;
    case DriveMode::effort:
      t.effort = std::clamp(*target, -limits.effort, limits.effort);
      t.friction += joint.drive_friction;
      break;
    case DriveMode::position:
    case DriveMode::acceleration:
    case DriveMode::passive:
      break;
  }
  return t;
}

DriveTarget position_drive_target(const RigidBody& body, const JointState& joint, const PdGains& gains,
                                  const Reference& reference, double inertia, double dt) {
  const JointLimits& limits = body.limits;
  const ImplicitDrive drive = implicit_drive(gains, reference.position - joint.position, reference.velocity, dt);
  DriveTarget t;
  t.friction = limits.friction;
  if (drive.damping == 0) return t;
  t.tracks_velocity = true;
  t.velocity = drive.velocity;
  t.damping = drive.damping;
  t.max_effort = limits.effort;
  if (!(std::abs(drive.velocity) > limits.velocity)) return t;
  // Where it would go faster than the model allows, it holds the limit, with no more effort than it has there.
  const double effort = drive.effort(joint.velocity) / (1 + dt * drive.damping / inertia);
  const double next = joint.velocity + dt / inertia * std::clamp(effort, -limits.effort, limits.effort);
  const double fastest = std::copysign(limits.velocity, drive.velocity);
  if (next * fastest < limits.velocity * limits.velocity) return t;
  t.velocity = fastest;
  t.damping = std::numeric_limits<double>::infinity();
  t.max_effort = std::min(limits.effort, std::abs(drive.effort(fastest)));
  return t;
}

}  // namespace muro::multibody
