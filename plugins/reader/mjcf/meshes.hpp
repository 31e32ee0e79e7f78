// SPDX-License-Identifier: MIT
// Meshes of a compiled model as files. MuJoCo's compiler moves each mesh to its centre and turns it to its principal
// axes. The model text that MuJoCo writes keeps the poses of the file.
#pragma once

#include <optional>
#include <vector>

#include "source.hpp"

namespace muro::mjcf {

/// A mesh file as a shape uses it.
struct PlacedMesh {
  std::string path;  ///< absolute
  Vec3 scale;
  Pose pose;  ///< in the frame of the body, with the 6 digits that MuJoCo writes
};

class Meshes {
 public:
  Meshes(const Compiled& compiled, const Source& source);

  /// Returns the mesh of a geom. Returns nothing and sets `problem` if it cannot be a shape.
  std::optional<PlacedMesh> of(int geom, std::string& problem) const;

 private:
  struct Asset {
    std::string path;  ///< empty: the mesh is in the MJCF itself
    Vec3 scale = Vec3::Ones();
    Vec3 reference = Vec3::Zero();  ///< refpos, refquat
    Quat turn = Quat::Identity();
  };
  void read_assets(const Element& root, const Source& source);
  void read_body(const Element& body);

  const mjModel* model_;
  std::vector<Asset> assets_;  ///< one for each mesh
  std::vector<Pose> geoms_;    ///< as written, one for each geom
  bool complete_ = false;
};

}  // namespace muro::mjcf
