// SPDX-License-Identifier: MIT
#pragma once

#include "assembly.hpp"
#include "muro/robot_builder.hpp"

namespace muro::sdf {

/// Gives the base of a robot what its model says beside its bodies: sensors, drives, links without weight, self
/// collision. To be called behind `base`.
void add_devices(const Assembly& assembly, const ::sdf::Model& model, const SourceFiles& sources, RobotBuilder& builder,
                 Problems& problems);

}  // namespace muro::sdf
