// SPDX-License-Identifier: MIT
#include "joint_drive_target.hpp"

#include <algorithm>

namespace muro::multibody {

DriveTarget drive_target_of(const RigidBody& body, const JointState& joint, const JointState* leader,
                            const double* target, double position_gain) {
  const JointLimits& limits = body.limits;
  DriveTarget t;
  t.max_effort = limits.effort;
  if (leader) {
    t.tracks_velocity = true;
    t.velocity = body.multiplier * leader->velocity +
                 position_gain * (body.offset + body.multiplier * leader->position - joint.position);
    return t;
  }
  switch (body.drive) {
    case DriveMode::velocity:
      t.tracks_velocity = true;
      t.velocity = std::clamp(*target, -limits.velocity, limits.velocity);
      break;
    case DriveMode::position: {
      t.tracks_velocity = true;
      const double position = std::clamp(*target, limits.lower, limits.upper);
      t.velocity = std::clamp(position_gain * (position - joint.position), -limits.velocity, limits.velocity);
      break;
    }
    case DriveMode::effort:
      t.effort = std::clamp(*target, -limits.effort, limits.effort);
      break;
    case DriveMode::acceleration:
    case DriveMode::passive:
      break;
  }
  return t;
}

}  // namespace muro::multibody
