// SPDX-License-Identifier: MIT
#pragma once

#include "assembly.hpp"
#include "muro/robot_builder.hpp"

namespace muro::sdf {

/// Gives the base of a robot the subsystems of its model: sensors, drives, gravity compensation for links without
/// weight, self collision. Call it directly after `base`.
void add_devices(const Assembly& assembly, const ::sdf::Model& model, const SourceFiles& sources, RobotBuilder& builder,
                 Problems& problems);

}  // namespace muro::sdf
