// SPDX-License-Identifier: MIT
// The description that all motions by multi-body engines share.
#pragma once

#include "muro/description.hpp"
#include "muro/features.hpp"
#include "plugins/motion/common/motion/forced_description.hpp"

namespace muro::multibody {

inline constexpr PropertyUse own_reads[] = {
    {"wrench.external", "of the base and every body with collision shapes"},
    {"collision.shapes", "of every body in the scene"},
    {"pose", "of bodies of other robots"},
    {"twist", "of bodies of other robots"},
    {"contact.world", "of other robots"},
};
inline constexpr PropertyUse own_writes[] = {
    {"joint.effort", "of every joint: what its drive applies"},
    {"wrench.contact", "of every body with collision shapes"},
    {keys::applied_wrench.name, "of every body with collision shapes, where somebody reads it"},
    {keys::contact_wrenches_of_motion.name, "of the base: what each contact did, where somebody reads it"},
    {"contact.world", "that this world answers for contacts"},
    {"twist.lag", "0.5: semi-implicit Euler"},
};
inline constexpr auto reads = joined(own_reads, reads_masses, reads_drive_targets, reads_start);
inline constexpr auto writes = joined(motion_writes, own_writes);
inline constexpr std::uint32_t capabilities = deterministic | restorable | world;
inline constexpr Features features =
    feature_forces | feature_joints | feature_velocity_targets | feature_position_targets | feature_effort_targets |
    feature_joint_limits | feature_joint_speed_limits | feature_joint_effort_limits | feature_joint_damping |
    feature_joint_friction | feature_mimic_joints | feature_link_dynamics | feature_gyroscopic | feature_contact |
    feature_friction | feature_restitution | feature_convex_meshes | feature_fixed_base | feature_self_collision;

/// Returns the description of a motion by an engine.
constexpr Description engine_description(std::string_view id, std::string_view version, std::string_view summary,
                                         const Rows<Parameter>& parameters, Features more_features = 0) {
  return {.id = id,
          .kind = Kind::motion,
          .version = version,
          .summary = summary,
          .parameters = parameters,
          .reads = reads,
          .writes = writes,
          .capabilities = capabilities,
          .features = features | more_features};
}

}  // namespace muro::multibody
