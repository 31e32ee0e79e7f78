// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "muro/robot_builder.hpp"
#include "plugins/common/model_file/mesh_path.hpp"

namespace muro::urdf {

/// Builds the robot that `bytes`, the contents of a URDF file in `folder`, describe; `packages` are folders of packages
/// that the user has named. What is wrong is reported to the builder; after an error in the document nothing is built.
void read_text(std::string bytes, const std::filesystem::path& folder, RobotBuilder& builder,
               const model_file::Packages& packages = {});

/// As read_text, for a file. Throws muro::Error when the file cannot be read.
void read_file(const std::string& path, RobotBuilder& builder, const model_file::Packages& packages = {});

}  // namespace muro::urdf
