// SPDX-License-Identifier: MIT
// Properties of joints.
#pragma once

#include "muro/key.hpp"

namespace muro::keys {

// Joints: properties of the joint's object. Revolute and continuous joints turn, prismatic ones shift.
inline constexpr Key<double> joint_position{"joint.position", "rad or m", "along the axis, 0 as modelled"};
inline constexpr Key<double> initial_joint_position{"joint.position.initial", "rad or m", "at the start"};
inline constexpr Key<double> joint_velocity{"joint.velocity", "rad/s or m/s", "along the axis"};
/// Derivative of the velocity in the last step. The property exists if a sensor reads it, as `acceleration`.
inline constexpr Key<double> joint_acceleration{"joint.acceleration", "rad/s^2 or m/s^2",
                                                "along the axis, in the last step"};
inline constexpr Key<double> joint_effort{"joint.effort", "N m or N", "what the drive applies along the axis",
                                          Role::motion_trait};
inline constexpr Key<double> joint_position_target{"joint.position.target", "rad or m", "wanted position",
                                                   Role::command};
inline constexpr Key<double> joint_velocity_target{"joint.velocity.target", "rad/s or m/s", "wanted velocity",
                                                   Role::command};
inline constexpr Key<double> joint_acceleration_target{"joint.acceleration.target", "rad/s^2 or m/s^2",
                                                       "wanted acceleration", Role::command};
inline constexpr Key<double> joint_effort_target{"joint.effort.target", "N m or N", "wanted effort", Role::command};
// Constants of a joint, written by the reader of its model.
/// DriveMode (toolkit/joint_drives.hpp) of the actuator that the model has for the joint. Passive if the model has
/// actuators only for other joints.
inline constexpr Key<std::uint32_t> joint_drive{"joint.drive", "1", "what the joint follows by its model"};
/// Constants of the actuator of a joint that follows positions: stiffness (target - position) - damping velocity.
inline constexpr Key<double> joint_drive_stiffness{"joint.drive.stiffness", "N m/rad or N/m",
                                                   "of the joint's position drive by its model"};
inline constexpr Key<double> joint_drive_damping{"joint.drive.damping", "N m s/rad or N s/m",
                                                 "of the joint's position drive by its model"};
// Properties of a drive in front of the motion, for joints that efforts drive. A motion finds them in
// `connect_by_name`.
inline constexpr Key<double> joint_drive_friction{"joint.drive.friction", "N m or N",
                                                  "the largest friction of the drive, beside that of the joint"};
inline constexpr Key<double> joint_drive_armature{"joint.drive.armature", "kg m^2 or kg",
                                                  "inertia of the drive's rotor, beside that of the joint"};

}  // namespace muro::keys
