// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "mesh_path.hpp"
#include "problems.hpp"

namespace muro::model_file {

/// Collects the meshes of a model that are not found, to report them together: one message for all meshes of a package,
/// and one for all that are named by paths.
class MissingMeshes {
 public:
  /// `at`: place of the element that names it. `to_touch`: it is a collision shape.
  void add(const std::string& name, const FileLocation& at, const MeshPath& missing, bool to_touch);
  void report(Problems& problems) const;

 private:
  struct Mesh {
    std::string name;
    std::vector<FileLocation> places;
  };
  struct Group {
    MeshPath missing;  ///< of its first mesh
    std::vector<Mesh> meshes;
    bool to_touch = false;
  };
  std::vector<Group> groups_;
};

}  // namespace muro::model_file
