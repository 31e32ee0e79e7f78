// SPDX-License-Identifier: MIT
#include "painted.hpp"

#include <assimp/material.h>
#include <assimp/postprocess.h>

#include <algorithm>
#include <filesystem>

#include "file.hpp"
#include "muro/algorithm.hpp"
#include "srgb.hpp"

namespace muro::mesh {

namespace {

namespace fs = std::filesystem;

constexpr unsigned all_but_looks = aiComponent_TANGENTS_AND_BITANGENTS | aiComponent_COLORS | aiComponent_BONEWEIGHTS |
                                   aiComponent_ANIMATIONS | aiComponent_LIGHTS | aiComponent_CAMERAS;

/// The file that a material means: as it says, beside the mesh, or by its name alone beside the mesh or in textures/.
std::string find_picture(const std::string& mesh, std::string name) {
  std::replace(name.begin(), name.end(), '\\', '/');
  if (name.rfind("file://", 0) == 0) name.erase(0, 7);
  const fs::path folder = fs::path(mesh).parent_path(), file = fs::path(name).filename();
  std::error_code code;
  for (const fs::path& path : {folder / name, folder / file, folder / "textures" / file,
                               folder.parent_path() / "materials" / "textures" / file})
    if (fs::is_regular_file(path, code)) return path.lexically_normal().string();
  return {};
}

/// Whose colours are linear light.
bool is_gltf(const std::string& path) {
  const std::string ending = File::ending_of(path);
  return ending == ".gltf" || ending == ".glb";
}

void paint(PaintedPart& part, const aiScene& scene, const aiMaterial& material, const std::string& path) {
  aiColor4D color;
  if (material.Get(AI_MATKEY_BASE_COLOR, color) == AI_SUCCESS ||
      material.Get(AI_MATKEY_COLOR_DIFFUSE, color) == AI_SUCCESS)
    part.color = Eigen::Vector4f(color.r, color.g, color.b, color.a).cast<double>().cwiseMax(0).cwiseMin(1);
  if (is_gltf(path))
    for (int k = 0; k < 3; ++k) part.color[k] = srgb_of(part.color[k]);
  aiString name;
  if (material.GetTexture(aiTextureType_BASE_COLOR, 0, &name) != AI_SUCCESS &&
      material.GetTexture(aiTextureType_DIFFUSE, 0, &name) != AI_SUCCESS)
    return;
  const aiTexture* const inside = scene.GetEmbeddedTexture(name.C_Str());
  if (!inside) {
    part.picture = find_picture(path, name.C_Str());
  } else if (inside->mHeight == 0) {  // as a file
    part.picture = path + ": " + name.C_Str();
    const auto* bytes = reinterpret_cast<const std::uint8_t*>(inside->pcData);
    part.picture_bytes.assign(bytes, bytes + inside->mWidth);
  }
  if (part.picture.empty())
    part.missing = name.C_Str();
  else if (!is_gltf(path))
    part.color.head<3>().setOnes();  // glTF multiplies; others have any colour beside a picture
}

}  // namespace

std::vector<PaintedPart> load_painted(const std::string& path, const Vec3& scale) {
  const File file(path, scale, all_but_looks, aiProcess_GenSmoothNormals | aiProcess_FlipUVs);
  std::vector<PaintedPart> parts;
  file.each_mesh([&](const aiMesh& m, const Eigen::Matrix4d& at) {
    PaintedPart part;
    const Mat3 turn = at.topLeftCorner<3, 3>();
    const Mat3 turn_normals = turn.inverse().transpose() * (turn.determinant() < 0 ? -1 : 1);
    for (unsigned v = 0; v < m.mNumVertices; ++v) {
      const aiVector3D& p = m.mVertices[v];
      Corner c{(at * Eigen::Vector4d(double(p.x), double(p.y), double(p.z), 1)).head<3>(), Vec3::UnitZ()};
      if (m.HasNormals()) {
        const aiVector3D& n = m.mNormals[v];
        const Vec3 normal = turn_normals * Vec3(double(n.x), double(n.y), double(n.z));
        if (normal.norm() > 0) c.normal = normal.normalized();
      }
      if (m.HasTextureCoords(0)) c.picture = {double(m.mTextureCoords[0][v].x), double(m.mTextureCoords[0][v].y)};
      if (!c.position.allFinite()) throw Error("mesh " + path + " has a vertex that is no number or infinite");
      part.corners.push_back(c);
    }
    for (unsigned f = 0; f < m.mNumFaces; ++f) {
      const aiFace& face = m.mFaces[f];
      if (face.mNumIndices != 3) continue;
      Triangle t{face.mIndices[0], face.mIndices[1], face.mIndices[2]};
      if (turn.determinant() < 0) std::swap(t[1], t[2]);
      part.triangles.push_back(t);
    }
    if (m.mMaterialIndex < file.scene().mNumMaterials)
      paint(part, file.scene(), *file.scene().mMaterials[m.mMaterialIndex], path);
    if (!part.triangles.empty()) parts.push_back(std::move(part));
  });
  if (parts.empty()) throw Error("mesh " + path + " has no triangle; a shape needs a surface made of faces");
  return parts;
}

}  // namespace muro::mesh
