// SPDX-License-Identifier: MIT
#include "joint_drive_target.hpp"

#include <algorithm>
#include <cmath>

namespace muro::multibody {

DriveTarget mimic_target(const RigidBody& body, const JointState& joint, const JointState& leader, double gain,
                         bool is_coupled) {
  DriveTarget t;
  t.mimic_lead = gain * (body.offset + body.multiplier * leader.position - joint.position);
  if (is_coupled) {
    t.friction = body.limits.friction;
    return t;
  }
  t.tracks_velocity = true;
  t.max_effort = body.limits.effort;
  t.velocity = body.multiplier * leader.velocity + t.mimic_lead;
  return t;
}

bool nears_speed_limit(double effort, const RigidBody& body, const JointState& joint) {
  return effort * joint.velocity > 0 && std::abs(joint.velocity) > 0.5 * body.limits.velocity;
}

double within_speed_limit(double effort, const RigidBody& body, const JointState& joint, double inertia, double dt) {
  const double room = std::max(0.0, body.limits.velocity - std::copysign(joint.velocity, effort * joint.velocity));
  return std::copysign(std::min(std::abs(effort), inertia * room / dt), effort);
}

DriveTarget drive_target_of(const RigidBody& body, const JointState& joint, const double* target) {
  const JointLimits& limits = body.limits;
  DriveTarget t;
  t.max_effort = limits.effort;
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
  // A drive that would go faster than the model allows holds the speed limit, with no more effort than it has there.
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
