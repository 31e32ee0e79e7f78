// SPDX-License-Identifier: MIT
// A wheel that a drive turns.
#pragma once

#include <algorithm>

#include "muro/algorithm.hpp"
#include "muro/robot.hpp"
#include "muro/vocabulary.hpp"
#include "parameters.hpp"

namespace muro::wheeled {

struct DriveTarget {
  Out<double> speed;  ///< rad/s, of the wheel's joint
  double most = 0;    ///< rad/s
};

/// The target of the wheel at a frame of `robot`, whose joint has these limits. Throws Error where it must not turn.
/// [setup]
inline DriveTarget drive_of(Connector& c, const RobotView& robot, std::uint32_t frame, const JointLimits& limits) {
  const ObjectId joint = robot.links[frame].joint_object;
  const double most = std::min(limits.velocity, c.parameters().real(max_wheel_speed.name));
  if (!(most > 0))
    throw Error("the joint `" + std::string(c.object_name(joint)) + "` has the velocity limit " + std::to_string(most) +
                "; a driven wheel needs one above 0, or none");
  return {c.optional_output(joint, keys::joint_velocity_target), most};
}

}  // namespace muro::wheeled
