// SPDX-License-Identifier: MIT
// A file of meshes as Assimp reads it.
#pragma once

#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <string>

#include "muro/geometry.hpp"

namespace muro::mesh {

class File {
 public:
  /// Reads all but what `left_out` (aiComponent, or-ed) names, faces as triangles, with `steps` (aiProcess, or-ed).
  /// Throws muro::Error with the path.
  File(const std::string& path, const Vec3& scale, unsigned left_out, unsigned steps);

  /// Calls visit(mesh, at) for each mesh of each node; `at`: from the mesh to the axes that mesh.hpp promises, scaled.
  template <class Visit>
  void each_mesh(Visit visit) const {
    walk(*scene().mRootNode, root_, visit);
  }
  /// Of a file's name, with its dot, in small letters.
  static std::string ending_of(const std::string& path);
  const aiScene& scene() const { return *importer_.GetScene(); }

 private:
  using Transform = Eigen::Matrix4d;
  static Transform transform_of(const aiNode& node);

  template <class Visit>
  void walk(const aiNode& node, const Transform& parent, Visit& visit) const {
    const Transform at = parent * transform_of(node);
    for (unsigned i = 0; i < node.mNumMeshes; ++i) visit(*scene().mMeshes[node.mMeshes[i]], at);
    for (unsigned i = 0; i < node.mNumChildren; ++i) walk(*node.mChildren[i], at, visit);
  }

  Assimp::Importer importer_;
  Transform root_ = Transform::Identity();
};

}  // namespace muro::mesh
