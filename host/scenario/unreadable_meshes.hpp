// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/robot_tree.hpp"
#include "host/scenario/builder.hpp"
#include "host/scenario/mesh_corners.hpp"

namespace muro::host {

/// Removes those collision meshes of models that have unreadable files, as readers do for missing files.
class UnreadableMeshes {
 public:
  UnreadableMeshes(MeshCorners& meshes, BuiltScenario& out) : meshes_(meshes), out_(out) {}

  /// `file`: path of the model. `scope`: prefix of the names of its links, such as "rover."
  void leave_out(RobotTree& tree, const std::string& file, const std::string& scope);
  /// Removes shapes from the scenery of a world file. `name`: name of the link.
  void leave_out(std::vector<Shape>& shapes, const TextTable& texts, const std::string& file, const std::string& name);
  /// Adds a warning for each file.
  void tell() const;

 private:
  /// An unreadable file, and the links that lose a shape.
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
