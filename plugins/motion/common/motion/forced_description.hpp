// SPDX-License-Identifier: MIT
// Lists that descriptions of motions by forces share.
#pragma once

#include "description.hpp"
#include "plugins/motion/common/position_drive/position_drive.hpp"
#include "plugins/motion/common/watch/parameters.hpp"

namespace muro {

/// Bodies that forces move.
inline constexpr PropertyUse reads_masses[] = {{"gravity", "on the world object; 0 0 -9.81 when absent"},
                                               {"inertial", "of every body"}};
/// Targets of drives in their modes.
inline constexpr PropertyUse reads_drive_targets[] = {
    {"joint.velocity.target", "of joints in mode velocity, and in mode position where something writes it"},
    {"joint.position.target", "of joints in mode position"},
    {"joint.effort.target", "of joints in mode effort"},
    {"joint.drive.friction", "of joints in mode effort, where something writes it"},
    {"joint.drive.armature", "of joints in mode effort, where something writes it"},
};
inline constexpr PropertyUse reads_acceleration_targets[] = {
    {"joint.acceleration.target", "of joints in mode acceleration"}};
/// Impacts within the last step, of motions that correct the path after them.
inline constexpr PropertyUse reads_impacts[] = {
    {"contact.impact", "on a base that impacts push: where impacts were within the last step"},
    {"contact.impact.time", "on the same: when they were"}};
inline constexpr PropertyUse writes_impact_step[] = {
    {"contact.impact.step", "of a base that impacts push: length of a step"}};

/// Lists of joints by mode, and the drives of those in mode position.
inline constexpr Parameter drive_parameters[] = {velocity_joints,   position_joints, effort_joints, passive_joints,
                                                 natural_frequency, drive_stiffness, drive_damping, interpolate};
inline constexpr Parameter watch_parameters[] = {watch::watch, watch::watch_speed, watch::watch_depth};

}  // namespace muro
