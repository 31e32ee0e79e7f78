// SPDX-License-Identifier: MIT
// The names of features and capabilities in descriptions, and what becomes of a robot where a feature is missing.
#pragma once

#include "muro/description.hpp"

namespace muro {

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
    {feature_rolling_resistance, "rolling_resistance", "nothing resists the rolling of its shapes"},
    {feature_spinning_resistance, "spinning_resistance", "nothing but friction resists the spinning of its shapes"},
    {feature_armature, "armature", "the rotors of its drives have no inertia"},
    {feature_heightmaps, "heightmaps", "it falls through heightmaps"},
};

/// The name of a single capability; "" for a bit that is none.
constexpr std::string_view name_of(Capability capability) {
  switch (capability) {
    case deterministic:
      return "deterministic";
    case batched:
      return "batched";
    case allocation_free:
      return "allocation_free";
    case restorable:
      return "restorable";
    case needs_gpu:
      return "needs_gpu";
    case world:
      return "world";
    case runs_alone:
      return "runs_alone";
  }
  return "";
}

}  // namespace muro
