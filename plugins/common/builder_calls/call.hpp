// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <utility>

#include "muro/vocabulary.hpp"

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
  gravity,
  scenery,
  model,
  world_intern,
  world_report,
};

/// The constants that a record can hold, by their call; each is an array but `inertial`.
inline constexpr std::array<std::pair<Call, const KeyInfo*>, 3> constants{
    {{Call::inertial, &keys::inertial},
     {Call::collision_shapes, &keys::collision_shapes},
     {Call::visual_shapes, &keys::visual_shapes}}};

}  // namespace muro::builder_calls
