// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "muro/model_reader.hpp"
#include "plugins/common/model_file/mesh_path.hpp"

namespace muro::sdf {

/// Builds the robot that `bytes`, the contents of an SDFormat file in `folder`, describe. What is wrong is reported to
/// the builder; after an error in the document nothing is built. `packages`: folders that the user has named.
void read_text(std::string bytes, const std::filesystem::path& folder, RobotBuilder& builder,
               const model_file::Packages& packages = {});
/// The same for a world. A model with mistakes is left out, and the rest is built.
void read_world_text(std::string bytes, const std::filesystem::path& folder, WorldBuilder& builder,
                     const model_file::Packages& packages = {});

/// As read_text, for a file. Throws muro::Error when the file cannot be read.
void read_file(const std::string& path, RobotBuilder& builder, const model_file::Packages& packages = {});
void read_world_file(const std::string& path, WorldBuilder& builder, const model_file::Packages& packages = {});

}  // namespace muro::sdf
