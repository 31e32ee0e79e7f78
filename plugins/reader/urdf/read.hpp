// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "muro/robot_builder.hpp"

namespace muro::urdf {

/// Builds the robot that `bytes`, the contents of a URDF file in `folder`, describe. What is wrong is
/// reported to the builder; after an error in the document nothing is built.
void read_text(std::string bytes, const std::filesystem::path& folder, RobotBuilder& builder);

/// As read_text, for a file. Throws muro::Error when the file cannot be read.
void read_file(const std::string& path, RobotBuilder& builder);

}  // namespace muro::urdf
