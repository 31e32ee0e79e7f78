// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "model_constants.hpp"
#include "muro/vocabulary.hpp"
#include "muro/vocabulary/model.hpp"

namespace muro::builder_calls {

/// A call of RobotBuilder or, from gravity on, of WorldBuilder.
enum class Call : std::uint8_t {
  base,
  fork,
  end,
  translation,
  rotation,
  revolute,
  prismatic,
  mimic,
  body,
  intern,
  report,
  inertial,
  collision_shapes,
  visual_shapes,
  visual_materials,
  model_subsystems,
  model_subsystem_places,
  initial_joint_position,
  joint_drive,
  joint_drive_stiffness,
  joint_drive_damping,
  joint_position_target,
  mjcf_file,
  mjcf_in_world,
  mjcf_body,
  mjcf_joint,
  gravity,
  friction_rule,
  scenery,
  model,
  world_intern,
  world_report,
};

/// Constants that a record can hold, by their call. Each is one value, except the shapes, their materials and the
/// subsystems, which are arrays.
inline constexpr std::array<std::pair<Call, const KeyInfo*>, 15> constants{
    {{Call::inertial, &keys::inertial},
     {Call::collision_shapes, &keys::collision_shapes},
     {Call::visual_shapes, &keys::visual_shapes},
     {Call::visual_materials, &keys::visual_materials},
     {Call::model_subsystems, &keys::model_subsystems},
     {Call::model_subsystem_places, &keys::model_subsystem_places},
     {Call::initial_joint_position, &keys::initial_joint_position},
     {Call::joint_drive, &keys::joint_drive},
     {Call::joint_drive_stiffness, &keys::joint_drive_stiffness},
     {Call::joint_drive_damping, &keys::joint_drive_damping},
     {Call::joint_position_target, &keys::joint_position_target},
     {Call::mjcf_file, &model_constants::mjcf_file},
     {Call::mjcf_in_world, &model_constants::mjcf_in_world},
     {Call::mjcf_body, &model_constants::mjcf_body},
     {Call::mjcf_joint, &model_constants::mjcf_joint}}};

}  // namespace muro::builder_calls
