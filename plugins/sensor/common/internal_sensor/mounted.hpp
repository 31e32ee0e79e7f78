// SPDX-License-Identifier: MIT
// Where an internal sensor sits: what all of them share.
#pragma once

#include "muro/toolkit/mounting.hpp"
#include "plugins/common/link_motion/link_motion.hpp"

namespace muro::internal_sensor {

/// The number of the link that carries the sensor of `item`. Throws Error where the scenario mounts it on a joint.
/// [setup]
std::uint32_t carrying_link(const Connector& c, const Item& item);

/// The same where it may sit in a joint, too: then the link behind the joint. [setup]
std::uint32_t carrying_link_or_joint(const Connector& c, const Item& item);

/// The numbers of the links behind the joints that a sensor looks at: those that the texts of the parameter `joints`
/// name, where a name may end with `*`; else the joint that it is mounted on. Throws Error with the joints of the robot
/// where there is none. [setup]
std::vector<std::uint32_t> sensed_joints(const Connector& c, const Item& item, std::string_view parameter);

/// The number of the link behind the one joint that it is mounted on. Throws Error where it is none. [setup]
std::uint32_t carrying_joint(const Connector& c, const Item& item);

/// How the device of `item` moves, whose place on its link the parameters `offset` and `rpy` give; writes
/// `sensor.origin`. [setup]
link_motion::LinkMotion device_motion(Connector& c, const Item& item, link_motion::Order order);

/// The constant of the scene, m/s^2 in world axes. [setup]
Vec3 gravity_of(const Connector& c);

/// Throws Error for a sensor that runs on demand, and so has no time between its readings: for those that take
/// differences of them. [setup]
inline void require_rate(const Connector& c) {
  if (c.rate() > 0) return;
  throw Error("it takes differences between its readings, so the time between them must be known; give it a `rate`");
}

}  // namespace muro::internal_sensor
