// SPDX-License-Identifier: MIT
#pragma once

#include <urdf_model/model.h>

#include "model.hpp"

namespace muro::urdf {

/// Builds the robot, depth first, with children in the order of their joints in the file.
void build(const ::urdf::ModelInterface& model, const ModelInfo& info, const Places& places, RobotBuilder& builder,
           Problems& problems);

}  // namespace muro::urdf
