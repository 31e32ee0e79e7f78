// SPDX-License-Identifier: MIT
// A mesh file, read by Assimp.
#pragma once

#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <string>

#include "muro/geometry.hpp"

namespace muro::mesh {

class MeshFile {
 public:
  /// Reads all components except those in `unused` (aiComponent, or-ed), with faces as triangles and with the
  /// post-processing of `steps` (aiProcess, or-ed). Throws muro::Error with the path.
  MeshFile(const std::string& path, const Vec3& scale, unsigned unused, unsigned steps);

  /// Calls visit(mesh, at) for each mesh of each node. `at`: transform from the mesh to the axes of mesh.hpp, scaled.
  template <class Visit>
  void each_mesh(Visit visit) const {
    walk(*scene().mRootNode, root_, visit);
  }
  /// Returns the extension of a path, with its dot, in lower case.
  static std::string extension_of(const std::string& path);
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
