// SPDX-License-Identifier: MIT
// Descriptions of the properties that internal sensors read.
#pragma once

#include "muro/description.hpp"
#include "muro/toolkit/mounting.hpp"

namespace muro::internal_sensor {

inline constexpr Parameter mounting_parameters[] = {mounting_offset, mounting_rpy};
inline constexpr PropertyUse reads_pose{"pose", "of the base"};
inline constexpr PropertyUse reads_twist{"twist", "of the base"};
inline constexpr PropertyUse reads_acceleration{"acceleration", "of the base"};
inline constexpr PropertyUse reads_joint_position{"joint.position", "of joints between the base and the device"};
inline constexpr PropertyUse reads_joint_velocity{"joint.velocity", "likewise"};
inline constexpr PropertyUse reads_joint_acceleration{"joint.acceleration", "likewise"};
inline constexpr PropertyUse reads_gravity{"gravity", "on the world object; 0 0 -9.81 when absent"};
inline constexpr PropertyUse reads_contact{"wrench.contact", "of the link, at motions by engines"};
inline constexpr PropertyUse reads_contacts_of_law{"contact.wrenches.law", "of the robot, where contact.* answers"};
inline constexpr PropertyUse reads_contacts_of_motion{
    "contact.wrenches.motion", "of the robot, at motions by engines; of others, where no force moves it"};
inline constexpr PropertyUse reads_contact_world{"contact.world", "of the robot: whether forces move it"};

}  // namespace muro::internal_sensor
