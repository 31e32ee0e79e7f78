// SPDX-License-Identifier: MIT
// Speed that a drive gives to a wheel.
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "muro/algorithm.hpp"
#include "muro/base/number_text.hpp"
#include "muro/robot.hpp"
#include "muro/vocabulary.hpp"
#include "parameters.hpp"

namespace muro::wheels {

struct DriveTarget {
  Out<double> speed;     ///< rad/s, of the wheel's joint; null if the wheel is not driven
  double max_speed = 0;  ///< rad/s
};

/// Returns the target of the wheel whose joint leads to `link` of `robot` and has these limits. Throws Error if the
/// joint must not turn. [setup]
inline DriveTarget connect_drive_target(Connector& c, const RobotView& robot, std::uint32_t link,
                                        const JointLimits& limits) {
  const ObjectId joint = robot.links[link].joint_object;
  const double max_speed = std::min(limits.velocity, c.parameters().real(max_wheel_speed.name));
  if (!(max_speed > 0))
    throw Error("the joint `" + std::string(c.object_name(joint)) + "` has the velocity limit " +
                number_text(max_speed) + "; a driven wheel needs one above 0, or none");
  return {c.optional_output(joint, keys::joint_velocity_target), max_speed};
}

/// Slows down all wheels by the same factor if a target exceeds the limit of its wheel, so that the path keeps its
/// curvature. Each wheel has a member `DriveTarget target`. [step]
template <class Wheel>
void limit_speeds(std::span<Wheel> wheels) {
  double excess = 1;
  for (const Wheel& w : wheels)
    if (w.target.speed) excess = std::max(excess, std::abs(*w.target.speed) / w.target.max_speed);
  for (const Wheel& w : wheels)
    if (w.target.speed) *w.target.speed /= excess;
}

}  // namespace muro::wheels
