// SPDX-License-Identifier: MIT
// Meshes of a compiled model as files: MuJoCo's compiler moves each to its centre and turns it to its principal axes.
// The model as MuJoCo writes it has them where the file has them.
#pragma once

#include <optional>
#include <vector>

#include "source.hpp"

namespace muro::mjcf {

/// A mesh of a file, as a shape has it.
struct PlacedMesh {
  std::string path;  ///< absolute
  Vec3 scale;
  Pose pose;  ///< in the frame of the body; to 6 digits, which MuJoCo writes
};

class Meshes {
 public:
  Meshes(const Compiled& compiled, const Source& source);

  /// The mesh of a geom; nothing, and why, where it cannot be a shape.
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
  std::vector<Asset> assets_;  ///< one per mesh
  std::vector<Pose> geoms_;    ///< as written, one per geom
  bool complete_ = false;
};

}  // namespace muro::mjcf
