// SPDX-License-Identifier: MIT
#pragma once

#include <urdf_model/model.h>

#include <filesystem>

#include "model.hpp"

namespace muro::urdf {

/// Builds the robot, depth first, children in the order of their joints in the file. `folder` is where
/// the model lies; relative paths of meshes start there.
void build(const ::urdf::ModelInterface& model, const ModelInfo& info, const std::filesystem::path& folder,
           RobotBuilder& builder, Problems& problems);

}  // namespace muro::urdf
