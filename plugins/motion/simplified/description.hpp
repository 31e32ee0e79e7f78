// SPDX-License-Identifier: MIT
// The description of motion.simplified: its parameters, the properties that it reads and writes, and its features.
#pragma once

#include "muro/plugin.hpp"
#include "plugins/motion/common/motion/forced_description.hpp"

namespace muro::simplified {

inline constexpr std::string_view joint_modes[] = {"auto", "velocity", "position", "acceleration", "effort", "passive"};
inline constexpr std::string_view position_drive_kinds[] = {"pd", "ideal"};
inline constexpr std::string_view base_modes[] = {"free", "fixed"};
inline constexpr Parameter own_parameters[] = {
    text("joints", "auto",
         "what joints follow that no list below names; auto: what an algorithm writes, position or velocity; a joint "
         "that none commands turns freely, beside others that are commanded")
        .one_of(joint_modes),
    real("max_joint_acceleration", "rad/s^2 or m/s^2", 100, "of every joint that follows a target other than an effort")
        .between(1e-6, 1e9),
    boolean("effort_limits", false,
            "drives that follow targets are no stronger than the model says, and give way to what pushes their links"),
    text("position_drives", "pd",
         "joints in mode position have PD drives, or meet targets whatever it takes, at the least cost")
        .one_of(position_drive_kinds),
    real("armature", "kg m^2 or kg", 0,
         "inertia of each drive beyond that of the model, felt by joints that forces move")
        .between(0, 1e6),
    text("base", "free", "free to move, or fixed to the world where it starts").one_of(base_modes),
};
inline constexpr auto parameters = joined(own_parameters, drive_parameters, watch_parameters);
inline constexpr PropertyUse own_reads[] = {
    {"wrench.external", "of the base; of each body with a shape, too, where forces move joints: sums"},
    {keys::contact_wrenches_of_law.name, "of the robot, where somebody reads `wrench.applied`"},
    {"contacts", "of the robot, where a contact algorithm reads them: how deep it is in scenery"},
};
inline constexpr auto reads =
    joined(own_reads, reads_masses, reads_drive_targets, reads_acceleration_targets, reads_start, reads_impacts);
inline constexpr PropertyUse own_writes[] = {
    {"joint.effort", "of joints with PD drives or moved by forces: what the drive applies"},
    {keys::applied_wrench.name, "of links, where somebody reads it"},
    {"contact.world", "that the contact algorithm answers for all contacts"},
    {"twist.lag", "0: pose and twist are those of one instant"},
};
inline constexpr auto writes = joined(motion_writes, own_writes, writes_impact_step);
inline constexpr Description description{
    .id = "motion.simplified",
    .kind = Kind::motion,
    .version = "1.1.0",
    .summary =
        "One rigid body under external wrenches whose centre of mass and inertia follow the joints; "
        "joints follow their targets, or forces",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
    .features = feature_forces | feature_joints | feature_velocity_targets | feature_position_targets |
                feature_acceleration_targets | feature_effort_targets | feature_joint_limits |
                feature_joint_speed_limits | feature_joint_effort_limits | feature_joint_damping |
                feature_joint_friction | feature_armature | feature_mimic_joints | feature_gyroscopic |
                feature_contact | feature_friction | feature_restitution | feature_rolling_resistance |
                feature_spinning_resistance | feature_convex_meshes | feature_concave_meshes | feature_heightmaps |
                feature_fixed_base,
};

}  // namespace muro::simplified
