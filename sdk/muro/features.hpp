// SPDX-License-Identifier: MIT
// Abilities of motions. Each motion declares them, tests check them, and a host compares them with what a robot uses.
#pragma once

#include <cstdint>

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
  feature_rolling_resistance = 1 << 21,   ///< rolling resistance of the shapes
  feature_spinning_resistance = 1 << 22,  ///< spinning resistance of the shapes
  feature_armature = 1 << 23,             ///< the rotors of drives have inertia
  feature_heightmaps = 1 << 24,           ///< heightmaps of the scenery carry it
};

}  // namespace muro
