// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>

#include "muro/model_reader.hpp"
#include "plugins/common/model_file/mesh_path.hpp"

namespace muro::sdf {

/// Builds the robot that `bytes` describes, the contents of an SDFormat file in `folder`. Problems are reported to the
/// builder; after an error in the document nothing is built. `packages`: folders that the user has named.
void read_text(std::string bytes, const std::filesystem::path& folder, RobotBuilder& builder,
               const model_file::Packages& packages = {});
/// Builds the world that `bytes` describes. Models with mistakes are left out, the others are built.
void read_world_text(std::string bytes, const std::filesystem::path& folder, WorldBuilder& builder,
                     const model_file::Packages& packages = {});

/// Builds the robot of a file, see read_text. Throws muro::Error if the file cannot be read.
void read_file(const std::string& path, RobotBuilder& builder, const model_file::Packages& packages = {});
void read_world_file(const std::string& path, WorldBuilder& builder, const model_file::Packages& packages = {});

}  // namespace muro::sdf
