// SPDX-License-Identifier: MIT
#pragma once

#include "assembly.hpp"
#include "muro/robot_builder.hpp"

namespace muro::sdf {

/// Builds the robot, depth first, with children in the order of their joints in the file. Bodies to which no joint
/// leads are fixed to the base at their poses.
void build(Assembly& assembly, const ::sdf::Model& model, const SourceFiles& sources, RobotBuilder& builder,
           Problems& problems);

}  // namespace muro::sdf
