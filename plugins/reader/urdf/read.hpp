// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "muro/robot_builder.hpp"
#include "plugins/common/model_file/mesh_path.hpp"

namespace muro::urdf {

/// Builds the robot that `bytes` describes, the contents of a URDF file in `folder`. `packages`: folders of packages
/// that the user has named. Problems are reported to the builder; after an error in the document nothing is built.
void read_text(std::string bytes, const std::filesystem::path& folder, RobotBuilder& builder,
               const model_file::Packages& packages = {});

/// Builds the robot of a file, see read_text. Throws muro::Error if the file cannot be read.
void read_file(const std::string& path, RobotBuilder& builder, const model_file::Packages& packages = {});

}  // namespace muro::urdf
