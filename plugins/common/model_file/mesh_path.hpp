// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace muro::model_file {

struct MeshPath {
  std::string path;                             ///< absolute; empty when there is no such file
  bool other_case = false;                      ///< the file's name differs in upper and lower case
  std::vector<std::filesystem::path> searched;  ///< where it was looked for
};

/// Finds the file that a mesh's `filename` means, for a model in `folder` (absolute):
/// - package://NAME/...  a folder NAME above or beside the model, in ROS_PACKAGE_PATH, in share/ of AMENT_PREFIX_PATH
/// - model://NAME/...    likewise, and in GAZEBO_MODEL_PATH and GZ_SIM_RESOURCE_PATH
/// - file://..., an absolute path, or one relative to the model's folder
/// Backslashes count as slashes; of a path with a drive letter, the last parts are looked for beside the model.
MeshPath find_mesh(std::string_view filename, const std::filesystem::path& folder);

/// What to do where no file of this name is found: "correct its path".
std::string advice_for_missing(std::string_view filename);

/// As find_mesh; the name may be that of a folder.
MeshPath find_file_or_folder(std::string_view name, const std::filesystem::path& folder);

}  // namespace muro::model_file
