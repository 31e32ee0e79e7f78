// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "muro/model_reader.hpp"

namespace muro::sdf {

/// Builds the robot that `bytes`, the contents of an SDFormat file in `folder`, describe. What is wrong is reported to
/// the builder; after an error in the document nothing is built.
void read_text(std::string bytes, const std::filesystem::path& folder, RobotBuilder& builder);
/// The same for a world.
void read_world_text(std::string bytes, const std::filesystem::path& folder, WorldBuilder& builder);

/// As read_text, for a file. Throws muro::Error when the file cannot be read.
void read_file(const std::string& path, RobotBuilder& builder);
void read_world_file(const std::string& path, WorldBuilder& builder);

}  // namespace muro::sdf
