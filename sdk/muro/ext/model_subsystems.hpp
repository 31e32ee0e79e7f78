// SPDX-License-Identifier: MIT
// What a model brings beside its bodies: sensors, drives, parameters of motions.
#pragma once

#include "muro/key.hpp"
#include "muro/object.hpp"

namespace muro::keys {

/// On the base, for RobotBuilder::set_array: each text is one subsystem, written as in a scenario,
/// `lidar: {use: laser.embree, on: base_link, rate: 10}`. One without `use`, named `motion`, holds parameters of the
/// robot's motions. What the scenario says goes before. A robot has no such property.
inline constexpr Key<TextId> model_subsystems{"model.subsystems", "1", "array: subsystems that the model brings"};
/// On the base, beside them: line and column of each in the model's file, from 1; 0: unknown.
inline constexpr Key<std::int32_t> model_subsystem_places{"model.subsystems.places", "1",
                                                          "array: line and column of each of model.subsystems"};

}  // namespace muro::keys
