// SPDX-License-Identifier: MIT
#include <assimp/config.h>
#include <assimp/postprocess.h>
#include <assimp/scene.h>
#include <assimp/Importer.hpp>

#include <algorithm>
#include <filesystem>

#include "mesh.hpp"
#include "muro/algorithm.hpp"

namespace muro::mesh {
namespace {

/// What is left: positions and faces.
constexpr int all_but_shape = aiComponent_NORMALS | aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
                              aiComponent_TEXCOORDS | aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS |
                              aiComponent_TEXTURES | aiComponent_LIGHTS | aiComponent_CAMERAS | aiComponent_MATERIALS;

using Transform = Eigen::Matrix4d;

Transform transform_of(const aiMatrix4x4& m) {
  Transform t;
  for (unsigned r = 0; r < 4; ++r)
    for (unsigned c = 0; c < 4; ++c) t(r, c) = double(m[r][c]);
  return t;
}

/// Files that state an axis that is up, which Assimp then makes y; all others are taken as they are.
bool comes_with_y_up(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(), [](unsigned char c) { return std::tolower(c); });
  return ending == ".dae" || ending == ".gltf" || ending == ".glb";
}

void add(const aiScene& scene, const aiNode& node, const Transform& parent, Mesh& out) {
  const Transform at = parent * transform_of(node.mTransformation);
  const bool mirrored = at.topLeftCorner<3, 3>().determinant() < 0;
  for (unsigned i = 0; i < node.mNumMeshes; ++i) {
    const aiMesh& m = *scene.mMeshes[node.mMeshes[i]];
    const auto first = std::uint32_t(out.vertices.size());
    for (unsigned v = 0; v < m.mNumVertices; ++v) {
      const aiVector3D& p = m.mVertices[v];
      out.vertices.push_back((at * Eigen::Vector4d(double(p.x), double(p.y), double(p.z), 1)).head<3>());
    }
    for (unsigned f = 0; f < m.mNumFaces; ++f) {
      const aiFace& face = m.mFaces[f];
      if (face.mNumIndices != 3) continue;  // points and lines
      Triangle t{first + face.mIndices[0], first + face.mIndices[1], first + face.mIndices[2]};
      if (mirrored) std::swap(t[1], t[2]);
      out.triangles.push_back(t);
    }
  }
  for (unsigned i = 0; i < node.mNumChildren; ++i) add(scene, *node.mChildren[i], at, out);
}

}  // namespace

Mesh load(const std::string& path, const Vec3& scale) {
  const auto fail = [&](const std::string& what) -> Error { return Error("mesh " + path + " " + what); };
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code))
    throw fail("is not there; give the path of a DAE, STL, OBJ or glTF file");
  if (!scale.allFinite() || scale.cwiseAbs().minCoeff() <= 0)
    throw fail("has a scale of " + std::to_string(scale.x()) + " " + std::to_string(scale.y()) + " " +
               std::to_string(scale.z()) + "; each factor must be finite and not 0");
  Assimp::Importer importer;
  importer.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, all_but_shape);
  const aiScene* const scene = importer.ReadFile(path, aiProcess_RemoveComponent | aiProcess_Triangulate);
  if (!scene || !scene->mRootNode)
    throw fail("cannot be read: " + std::string(importer.GetErrorString()) + "; use a DAE, STL, OBJ or glTF file");
  Transform root = Transform::Identity();
  if (comes_with_y_up(path)) root.topLeftCorner<3, 3>() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  root.topLeftCorner<3, 3>() = (scale.asDiagonal() * root.topLeftCorner<3, 3>()).eval();
  Mesh m;
  add(*scene, *scene->mRootNode, root, m);
  if (!std::all_of(m.vertices.begin(), m.vertices.end(), [](const Vec3& v) { return v.allFinite(); }))
    throw fail("has a vertex that is no number or infinite; write the file anew");
  const std::size_t triangles = m.triangles.size();
  tidy(m);
  if (m.triangles.empty())
    throw fail("has no triangle with an area (" + std::to_string(triangles) +
               " without); a shape needs a surface made of faces");
  if (is_closed(m) && volume_of(m) < 0)
    for (Triangle& t : m.triangles) std::swap(t[1], t[2]);
  return m;
}

}  // namespace muro::mesh
