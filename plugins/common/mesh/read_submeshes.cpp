// SPDX-License-Identifier: MIT
#include <assimp/material.h>
#include <assimp/postprocess.h>

#include <algorithm>
#include <filesystem>

#include "mesh_file.hpp"
#include "muro/algorithm.hpp"
#include "muro/base/limits.hpp"
#include "read_mesh.hpp"
#include "srgb.hpp"

namespace muro::mesh {

namespace {

namespace fs = std::filesystem;

constexpr unsigned unused_by_pictures = aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS |
                                        aiComponent_BONEWEIGHTS | aiComponent_ANIMATIONS | aiComponent_LIGHTS |
                                        aiComponent_CAMERAS;

/// Finds the texture file of a material: at its path relative to the mesh, or by its name beside the mesh or in
/// textures/.
std::string find_texture(const std::string& mesh, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  if (name.rfind("file://", 0) == 0) name.erase(0, 7);
  const fs::path folder = fs::path(mesh).parent_path(), file = fs::path(name).filename();
  std::error_code code;
  for (const fs::path& path : {folder / name, folder / file, folder / "textures" / file,
                               folder.parent_path() / "materials" / "textures" / file})
    if (fs::is_regular_file(path, code)) return path.lexically_normal().string();
  return {};
}

/// Whether the file is glTF, which has colours in linear light.
bool is_gltf(const std::string& path) {
  const std::string extension = MeshFile::extension_of(path);
  return extension == ".gltf" || extension == ".glb";
}

void set_material(Submesh& submesh, const aiScene& scene, const aiMaterial& material, const std::string& path) {
  aiColor4D color;
  if (material.Get(AI_MATKEY_BASE_COLOR, color) == AI_SUCCESS ||
      material.Get(AI_MATKEY_COLOR_DIFFUSE, color) == AI_SUCCESS)
    submesh.color = Eigen::Vector4f(color.r, color.g, color.b, color.a).cast<double>().cwiseMax(0).cwiseMin(1);
  if (is_gltf(path))
    for (int k = 0; k < 3; ++k) submesh.color[k] = srgb_of(submesh.color[k]);
  aiString name;
  if (material.GetTexture(aiTextureType_BASE_COLOR, 0, &name) != AI_SUCCESS &&
      material.GetTexture(aiTextureType_DIFFUSE, 0, &name) != AI_SUCCESS)
    return;
  const aiTexture* const embedded = scene.GetEmbeddedTexture(name.C_Str());
  if (!embedded) {
    submesh.texture = find_texture(path, name.C_Str());
  } else if (embedded->mHeight == 0) {  // compressed, as in a file
    submesh.texture = path + ": " + name.C_Str();
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(embedded->pcData);
    submesh.texture_bytes.assign(bytes, bytes + embedded->mWidth);
  }
  if (submesh.texture.empty())
    submesh.missing_texture = name.C_Str();
  else if (!is_gltf(path))
    submesh.color.head<3>()
        .setOnes();  // glTF multiplies colour and texture; in other formats the colour beside a texture means nothing
}

/// `at`: transform from the mesh to the result.
Submesh geometry_of(const aiMesh& m, const Eigen::Matrix4d& at, const std::string& path) {
  Submesh submesh;
  const Mat3 linear = at.topLeftCorner<3, 3>();
  const bool is_mirrored = linear.determinant() < 0;
  const Mat3 for_normals = linear.inverse().transpose() * (is_mirrored ? -1 : 1);
  for (unsigned i = 0; i < m.mNumVertices; ++i) {
    const aiVector3D& p = m.mVertices[i];
    TexturedVertex v{(at * Eigen::Vector4d(double(p.x), double(p.y), double(p.z), 1)).head<3>(), Vec3::UnitZ()};
    if (m.HasNormals()) {
      const aiVector3D& n = m.mNormals[i];
      const Vec3 normal = for_normals * Vec3(double(n.x), double(n.y), double(n.z));
      if (normal.norm() > 0) v.normal = normal.normalized();
    }
    if (m.HasTextureCoords(0))
      v.texture_coordinates = {double(m.mTextureCoords[0][i].x), double(m.mTextureCoords[0][i].y)};
    if (!limits::within(limits::position, v.position))
      throw Error("mesh " + path +
                  " has a vertex with a coordinate that is not from -1e8 to 1e8 m; write the file anew, in metres");
    submesh.vertices.push_back(v);
  }
  for (unsigned f = 0; f < m.mNumFaces; ++f) {
    const aiFace& face = m.mFaces[f];
    if (face.mNumIndices != 3) continue;
    Triangle t{face.mIndices[0], face.mIndices[1], face.mIndices[2]};
    if (is_mirrored) std::swap(t[1], t[2]);
    submesh.triangles.push_back(t);
  }
  return submesh;
}

}  // namespace

std::vector<Submesh> read_submeshes(const std::string& path, const Vec3& scale) {
  const MeshFile file(path, scale, unused_by_pictures, aiProcess_GenSmoothNormals | aiProcess_FlipUVs);
  std::vector<Submesh> submeshes;
  file.each_mesh([&](const aiMesh& m, const Eigen::Matrix4d& at) {
    Submesh submesh = geometry_of(m, at, path);
    if (submesh.triangles.empty()) return;
    if (m.mMaterialIndex < file.scene().mNumMaterials)
      set_material(submesh, file.scene(), *file.scene().mMaterials[m.mMaterialIndex], path);
    submeshes.push_back(std::move(submesh));
  });
  if (submeshes.empty()) throw Error("mesh " + path + " has no triangle; a shape needs a surface made of faces");
  return submeshes;
}

}  // namespace muro::mesh
