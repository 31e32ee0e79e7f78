// SPDX-License-Identifier: MIT
#pragma once

#include <filesystem>
#include <map>
#include <string>
#include <vector>

namespace muro::model_file {

/// Folders of packages and models by name, from the scenario.
using Packages = std::map<std::string, std::filesystem::path>;

struct MeshPath {
  std::string path;                             ///< absolute; empty if there is no such file
  bool other_case = false;                      ///< the file's name differs in upper and lower case
  bool elsewhere = false;                       ///< it is beside the model, and not where the name says
  std::vector<std::filesystem::path> searched;  ///< places that were searched
  std::string package;                          ///< NAME of package://NAME and model://NAME
  bool has_package = false;                     ///< a folder of that package was found, with the file in it or without
};

/// Finds the file that a mesh's `filename` means, for a model in `folder` (absolute):
/// - package://NAME/..., model://NAME/...  If `packages` has NAME: only there. Otherwise in a folder NAME above or
///   beside the model; in a folder above it whose package.xml has that name; in the paths of ROS_PACKAGE_PATH and in
///   packages a few levels below them; in share/ of AMENT_PREFIX_PATH and CMAKE_PREFIX_PATH; in the paths of
///   GZ_SIM_RESOURCE_PATH, IGN_GAZEBO_RESOURCE_PATH, SDF_PATH and GAZEBO_MODEL_PATH. If there is no such folder at all,
///   the model's folder and the three above it are taken for the package
/// - file://..., an absolute path, or one relative to the model's folder, then to the paths of GZ_SIM_RESOURCE_PATH,
///   IGN_GAZEBO_RESOURCE_PATH, SDF_PATH and GAZEBO_RESOURCE_PATH. The last parts of an absolute path that does not
///   exist are searched beside the model and up to two folders above
/// Backslashes count as slashes, and a drive letter makes a path absolute.
MeshPath find_mesh(std::string_view filename, const std::filesystem::path& folder, const Packages& packages = {});

/// Finds a picture or a heightmap as find_mesh does, but only where its name says.
MeshPath find_file(std::string_view name, const std::filesystem::path& folder, const Packages& packages = {});

/// Returns a note that a mesh is read from another place than its name says; else empty.
std::string note_on(std::string_view filename, const MeshPath& found);

/// Returns what to do if no file of this name is found: "correct its path".
std::string advice_for_missing(std::string_view filename, const MeshPath& missing);

/// Returns the places that were searched, at most six: "/a/x.stl, /b/x.stl and 3 more places".
std::string searched_places(const MeshPath& missing);

/// Does the same as find_file; the name may also be that of a folder.
MeshPath find_file_or_folder(std::string_view name, const std::filesystem::path& folder, const Packages& packages = {});

}  // namespace muro::model_file
