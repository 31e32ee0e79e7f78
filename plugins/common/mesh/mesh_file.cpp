// SPDX-License-Identifier: MIT
#include "mesh_file.hpp"

#include <assimp/DefaultIOSystem.h>
#include <assimp/config.h>
#include <assimp/postprocess.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include "muro/algorithm.hpp"
#include "muro/base/number_text.hpp"
#include "plugins/common/parser_process/limits.hpp"
#include "plugins/common/text/lfs_pointer.hpp"
#include "plugins/common/text/one_line.hpp"

namespace muro::mesh {

namespace {

/// Whether the format defines which axis is up. Assimp then makes it y. It keeps the axes of other formats.
bool has_y_up(const std::string& path) {
  const std::string extension = MeshFile::extension_of(path);
  return extension == ".dae" || extension == ".gltf" || extension == ".glb";
}

/// Files that Assimp opens, also those that a mesh names. Refuses devices and pipes, and allows more time for large
/// files.
class Files final : public Assimp::DefaultIOSystem {
 public:
  Assimp::IOStream* Open(const char* file, const char* mode) override {
    std::error_code code;
    const auto size = std::filesystem::file_size(file, code);
    if (code || !std::filesystem::is_regular_file(file, code) || std::string_view(mode).find('w') != std::string::npos)
      return nullptr;
    // valid files take 10 to 60 times their size in memory
    if (opened_.insert(file).second) parser_process::allow(parser_process::allowance_for(size, 200, 2));
    return DefaultIOSystem::Open(file, mode);
  }

 private:
  std::set<std::string> opened_;
};

/// Returns the first bytes of a file.
std::string beginning_of(const std::string& path) {
  std::string begin(64, '\0');
  std::ifstream(path, std::ios::binary).read(begin.data(), std::streamsize(begin.size()));
  return begin;
}

/// Returns the reason that Assimp gives for a file that it cannot read.
std::string reason_of(const std::string& text) {
  if (text.find("bad_a") != text.npos || text.find("bad alloc") != text.npos || text.find("vector::") != text.npos)
    return "it says that it holds more than fits into memory";
  return one_line(text);
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
    throw fail("has a scale of " + number_text(scale.x()) + " " + number_text(scale.y()) + " " +
               number_text(scale.z()) + "; each factor must be finite and not 0");
  if (is_lfs_pointer(beginning_of(path))) throw fail(std::string(is_lfs_pointer_text));
  importer_.SetIOHandler(new Files);  // the importer owns it
  importer_.SetPropertyInteger(AI_CONFIG_PP_RVC_FLAGS, int(unused));
  importer_.SetPropertyFloat(AI_CONFIG_PP_GSN_MAX_SMOOTHING_ANGLE, 40);
  const aiScene* const scene = importer_.ReadFile(path, aiProcess_RemoveComponent | aiProcess_Triangulate | steps);
  if (!scene || !scene->mRootNode)
    throw fail("cannot be read: " + reason_of(importer_.GetErrorString()) + "; use a DAE, STL, OBJ or glTF file");
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
