// SPDX-License-Identifier: MIT
#include "mesh_file.hpp"

#include <assimp/config.h>
#include <assimp/postprocess.h>

#include <algorithm>
#include <filesystem>

#include "muro/algorithm.hpp"

namespace muro::mesh {

namespace {

/// Formats that define which axis is up, which Assimp then makes y; the axes of other formats are kept.
bool has_y_up(const std::string& path) {
  const std::string extension = MeshFile::extension_of(path);
  return extension == ".dae" || extension == ".gltf" || extension == ".glb";
}

}  // namespace

std::string MeshFile::extension_of(const std::string& path) {
  std::string extension = std::filesystem::path(path).extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return std::tolower(c); });
  return extension;
}

MeshFile::MeshFile(const std::string& path, const Vec3& scale, unsigned unused, unsigned steps) {
  const auto fail = [&](const std::string& what) -> Error { return Error("mesh " + path + " " + what); };
  std::error_code code;
  if (!std::filesystem::is_regular_file(path, code))
    throw fail("is not there; give the path of a DAE, STL, OBJ or glTF file");
  if (!scale.allFinite() || scale.cwiseAbs().minCoeff() <= 0)
    throw fail("has a scale of " + std::to_string(scale.x()) + " " + std::to_string(scale.y()) + " " +
               std::to_string(scale.z()) + "; each factor must be finite and not 0");
  importer_.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, int(unused));
  importer_.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, 40);
  const aiScene* const scene = importer_.ReadFile(path, aiProcess_RemoveComponent | aiProcess_Triangulate | steps);
  if (!scene || !scene->mRootNode)
    throw fail("cannot be read: " + std::string(importer_.GetErrorString()) + "; use a DAE, STL, OBJ or glTF file");
  if (has_y_up(path)) root_.topLeftCorner<3, 3>() << 1, 0, 0, 0, 0, -1, 0, 1, 0;
  root_.topLeftCorner<3, 3>() = (scale.asDiagonal() * root_.topLeftCorner<3, 3>()).eval();
}

MeshFile::Transform MeshFile::transform_of(const aiNode& node) {
  Transform t;
  for (unsigned r = 0; r < 4; ++r)
    for (unsigned c = 0; c < 4; ++c) t(r, c) = double(node.mTransformation[r][c]);
  return t;
}

}  // namespace muro::mesh
