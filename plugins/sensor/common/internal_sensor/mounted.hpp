// SPDX-License-Identifier: MIT
// The mounting of internal sensors: functions that all of them share.
#pragma once

#include "muro/toolkit/mounting.hpp"
#include "plugins/common/link_motion/link_motion.hpp"

namespace muro::internal_sensor {

/// Returns the number of the link that carries the sensor of `item`. Throws Error if the scenario mounts it on a joint.
/// [setup]
std::uint32_t carrying_link(const Connector& c, const Item& item);

/// Returns this number also for a sensor that is mounted on a joint: then of the link behind the joint. [setup]
std::uint32_t carrying_link_or_joint(const Connector& c, const Item& item);

/// Returns the numbers of the links behind the joints that a sensor reads. These are the joints named by the texts of
/// the parameter `joints`, in which a name may end with `*`, or else the joint on which it is mounted. Throws Error
/// with the joints of the robot if there is none. [setup]
std::vector<std::uint32_t> sensed_joints(const Connector& c, const Item& item, std::string_view parameter);

/// Returns the number of the link behind the joint that carries the sensor. Throws Error if none does. [setup]
std::uint32_t carrying_joint(const Connector& c, const Item& item);

/// Returns the motion of the device of `item`. The parameters `offset` and `rpy` give its pose on its link. Writes
/// `sensor.origin`. [setup]
link_motion::LinkMotion device_motion(Connector& c, const Item& item, link_motion::Order order);

/// Returns the constant of the scene, m/s^2 in world axes. [setup]
Vec3 gravity_of(const Connector& c);

/// Throws Error for a sensor that runs on demand, as the time between its readings is not known. For sensors that use
/// differences of readings. [setup]
inline void require_rate(const Connector& c) {
  if (c.rate() > 0) return;
  throw Error("it takes differences between its readings, so the time between them must be known; give it a `rate`");
}

}  // namespace muro::internal_sensor
