// SPDX-License-Identifier: MIT
// What motions can do: declared by each, tested for each, and compared with what a robot uses before a run.
#pragma once

#include <cstdint>
#include <span>
#include <string_view>

namespace muro {

/// Bits of Feature.
using Features = std::uint64_t;

enum Feature : Features {
  feature_forces = 1,                     ///< `wrench.external` moves it
  feature_joints = 1 << 1,                ///< joints move
  feature_velocity_targets = 1 << 2,      ///< joints follow `joint.velocity.target`
  feature_position_targets = 1 << 3,      ///< joints follow `joint.position.target`
  feature_acceleration_targets = 1 << 4,  ///< joints follow `joint.acceleration.target`
  feature_effort_targets = 1 << 5,        ///< joints are driven by `joint.effort.target`
  feature_joint_limits = 1 << 6,          ///< joints stop at their limits of position
  feature_joint_speed_limits = 1 << 7,    ///< drives are no faster than the model says
  feature_joint_effort_limits = 1 << 8,   ///< drives are no stronger than the model says
  feature_joint_damping = 1 << 9,         ///< damping of the model slows joints
  feature_joint_friction = 1 << 10,       ///< Coulomb friction of the model holds joints
  feature_mimic_joints = 1 << 11,         ///< joints follow others
  feature_link_dynamics = 1 << 12,        ///< moving links push back: multi-body dynamics
  feature_gyroscopic = 1 << 13,           ///< a free body keeps its angular momentum
  feature_contact = 1 << 14,              ///< bodies stop each other
  feature_friction = 1 << 15,             ///< Coulomb friction of the shapes
  feature_restitution = 1 << 16,          ///< restitution of the shapes
  feature_convex_meshes = 1 << 17,        ///< meshes collide, as their convex hulls at least
  feature_concave_meshes = 1 << 18,       ///< meshes collide as they are
  feature_fixed_base = 1 << 19,           ///< the base can be fixed to the world
  feature_self_collision = 1 << 20,       ///< bodies of one robot can stop each other
};

struct FeatureInfo {
  Features bit;
  std::string_view name;         ///< in descriptions and messages
  std::string_view consequence;  ///< where it is missing: what becomes of a robot that uses it
};

inline constexpr FeatureInfo feature_infos[] = {
    {feature_forces, "forces", "forces and contacts do not move it"},
    {feature_joints, "joints", "its joints do not move"},
    {feature_velocity_targets, "velocity_targets", "its joints do not follow velocity targets"},
    {feature_position_targets, "position_targets", "its joints do not follow position targets"},
    {feature_acceleration_targets, "acceleration_targets", "its joints do not follow acceleration targets"},
    {feature_effort_targets, "effort_targets", "its joints cannot be driven by efforts"},
    {feature_joint_limits, "joint_limits", "joints pass their limits of position"},
    {feature_joint_speed_limits, "joint_speed_limits", "joints are faster than their limits of velocity"},
    {feature_joint_effort_limits, "joint_effort_limits", "joints are stronger than their limits of effort"},
    {feature_joint_damping, "joint_damping", "damping of joints is left out"},
    {feature_joint_friction, "joint_friction", "friction of joints is left out"},
    {feature_mimic_joints, "mimic_joints", "mimic joints follow nobody"},
    {feature_link_dynamics, "link_dynamics", "moving links do not push back on the base"},
    {feature_gyroscopic, "gyroscopic", "turning bodies do not keep their angular momentum"},
    {feature_contact, "contact", "it passes through other bodies"},
    {feature_friction, "friction", "friction of its shapes is left out"},
    {feature_restitution, "restitution", "its shapes do not rebound"},
    {feature_convex_meshes, "convex_meshes", "its meshes collide with nothing"},
    {feature_concave_meshes, "concave_meshes", "its meshes collide as their convex hulls"},
    {feature_fixed_base, "fixed_base", "its base cannot be fixed to the world"},
    {feature_self_collision, "self_collision", "its links pass through each other"},
};

}  // namespace muro
