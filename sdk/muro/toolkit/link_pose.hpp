// SPDX-License-Identifier: MIT
#pragma once

#include "muro/robot.hpp"
#include "muro/toolkit/rotations.hpp"

namespace muro {

/// Pose of a link's frame in its parent's frame when its joint is at `position` (rad or m).
inline Pose pose_in_parent(const Link& link, double position) {
  switch (link.joint) {
    case JointKind::revolute:
      return link.origin * Pose{Vec3::Zero(), rotation_of(Vec3(link.axis * position))};
    case JointKind::prismatic:
      return link.origin * Pose{link.axis * position, Quat::Identity()};
    case JointKind::fixed:
      break;
  }
  return link.origin;
}

}  // namespace muro
