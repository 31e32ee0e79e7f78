// SPDX-License-Identifier: MIT
#pragma once

#include "assembly.hpp"
#include "muro/robot_builder.hpp"

namespace muro::sdf {

/// Builds the robot, depth first, children in the order of their joints in the file. After an error that makes it no
/// tree, all bodies are built nevertheless, where they stand.
void build(Assembly& assembly, const ::sdf::Model& model, const SourceFiles& sources, RobotBuilder& builder,
           Problems& problems);

}  // namespace muro::sdf
