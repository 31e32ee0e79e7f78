// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/robot_tree.hpp"
#include "host/scenario/builder.hpp"
#include "host/scenario/mesh_corners.hpp"

namespace muro::host {

/// Leaves out those collision meshes of models whose files cannot be read, as readers do with files that are not there.
class UnreadableMeshes {
 public:
  UnreadableMeshes(MeshCorners& meshes, BuiltScenario& out) : meshes_(meshes), out_(out) {}

  /// `file`: that of the model. `scope`: of the names of its links, such as "rover."
  void leave_out(RobotTree& tree, const std::string& file, const std::string& scope);
  /// Of scenery of a world file. `name`: that of the link.
  void leave_out(std::vector<Shape>& shapes, const TextTable& texts, const std::string& file, const std::string& name);
  /// A warning for each file.
  void tell() const;

 private:
  /// A file that cannot be read, and the links that lose a shape by it.
  struct Lost {
    std::string file, mesh;
    std::vector<std::string> links;
  };
  bool is_lost(const Shape& shape, const TextTable& texts, const std::string& file, const std::string& link);

  MeshCorners& meshes_;
  BuiltScenario& out_;
  std::vector<Lost> lost_;
};

}  // namespace muro::host
