// SPDX-License-Identifier: MIT
// Description of motion.articulated: its parameters, the properties that it reads and writes, and its features.
#pragma once

#include "muro/plugin.hpp"
#include "plugins/motion/common/multibody/engine_parameters.hpp"

namespace muro::articulated {

inline constexpr std::string_view joint_modes[] = {"auto", "velocity", "position", "acceleration", "effort", "passive"};
inline constexpr std::string_view base_modes[] = {"free", "fixed"};
inline constexpr std::string_view integrators[] = {"semi_implicit", "rk4"};
inline constexpr Parameter own_parameters[] = {
    text("joints", "auto",
         "what joints follow that no list below names; auto: what an algorithm writes, position or velocity; a joint "
         "that none commands turns freely, beside others that are commanded")
        .one_of(joint_modes),
    text("base", "free", "whether the base is fixed to the world").one_of(base_modes),
    text("integrator", "semi_implicit",
         "semi-implicit Euler, or Runge and Kutta of order 4 for what moves smoothly within a step")
        .one_of(integrators),
    real("frequency", "Hz", 50, "stiffness of contacts: that of the robot bobbing on one of them").between(1, 1e4),
    real("correcting_speed", "m/s", 1, "bodies that are put into each other are parted no faster").between(0, 1e9),
    multibody::self_collision,
};
inline constexpr auto parameters = joined(own_parameters, drive_parameters, watch_parameters);
inline constexpr PropertyUse own_reads[] = {
    {"wrench.external", "of the base and every body with collision shapes"},
    {"contacts", "of the robot: those with scenery, with robots that no force moves, and among its links"},
    {"pose", "of bodies of other robots; with `self_collision` of its own"},
    {"twist", "of bodies of other robots; with `self_collision` of its own"},
    {"contact.world", "of other robots"},
    {"contact.carried_mass", "on the base: of all robots that carry each other"},
};
inline constexpr auto reads =
    joined(own_reads, reads_masses, reads_drive_targets, reads_acceleration_targets, reads_start, reads_impacts);
inline constexpr PropertyUse own_writes[] = {
    {"joint.effort", "of every joint: what its drive applies"},
    {"contact.kept", "of the base: what contacts keep from step to step"},
    {"contact.self.kept", "of the base, with `self_collision`: what contacts among links keep from step to step"},
    {"self_collision", "of the base, with that parameter: that `contacts` is to have those among its links"},
    {"wrench.contact", "of every body with collision shapes"},
    {keys::applied_wrench.name, "of every body with collision shapes, where somebody reads it"},
    {keys::contact_wrenches_of_motion.name, "of the base: what each contact did, where somebody reads it"},
    {"contact.world", "that the motion answers for contacts of the robot"},
    {"twist.lag", "0: pose and twist are those of one instant"},
};
inline constexpr auto writes = joined(motion_writes, own_writes, writes_impact_step);
inline constexpr Description description{
    .id = "motion.articulated",
    .kind = Kind::motion,
    .version = "1.0.0",
    .summary =
        "Multi-body dynamics by the articulated-body algorithm, up to eight robots at a time, drives and contacts "
        "implicit",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | batched | allocation_free | restorable,
    .features = feature_forces | feature_joints | feature_velocity_targets | feature_position_targets |
                feature_acceleration_targets | feature_effort_targets | feature_joint_limits |
                feature_joint_speed_limits | feature_joint_effort_limits | feature_joint_damping |
                feature_joint_friction | feature_armature | feature_mimic_joints | feature_link_dynamics |
                feature_gyroscopic | feature_contact | feature_friction | feature_restitution |
                feature_rolling_resistance | feature_spinning_resistance | feature_convex_meshes |
                feature_concave_meshes | feature_heightmaps | feature_fixed_base | feature_self_collision,
};

}  // namespace muro::articulated
