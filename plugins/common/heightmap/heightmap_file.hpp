// SPDX-License-Identifier: MIT
// Heightmaps from files.
#pragma once

#include <map>
#include <memory>
#include <string>
#include <vector>

#include "muro/scene.hpp"
#include "muro/toolkit/heightmap.hpp"
#include "plugins/common/mesh/mesh.hpp"

namespace muro::heightmap {

/// What the file of a heightmap holds; see README.md.
struct HeightmapFile {
  std::span<const float> values;  ///< as Heightmap::values; of a picture 0 (black) to 1 (white)
  std::uint32_t columns = 0, rows = 0;
  std::shared_ptr<const void> owner{};  ///< of the values: all libraries of a program share those of one file

  /// Owns these values.
  static HeightmapFile of(std::vector<float> values, std::uint32_t columns, std::uint32_t rows) {
    const auto owner = std::make_shared<const std::vector<float>>(std::move(values));
    return {*owner, columns, rows, owner};
  }

  /// Valid as long as the values are.
  Heightmap heightmap(const Vec3& size) const { return {values, columns, rows, size}; }
};

/// Reads a file (absolute path). Throws muro::Error with the path when the file is missing, is no heightmap or has more
/// nodes than 16384 x 16384. The file is read once while anybody has it, and again when it has changed. [setup]
HeightmapFile load(const std::string& path);

/// m: so far below the surface of a heightmap bodies are pushed up.
inline constexpr double depth_of_ground = 1000;

/// Around the surface, m.
Aabb bounds_of(const Heightmap& heightmap);

/// The surface as triangles, two a cell, for those that know meshes only. An open mesh that looks up.
mesh::Mesh mesh_of(const Heightmap& heightmap);

/// A cache of files: each is read once, or fails once. References stay valid as long as the store lives. [setup]
class Store {
 public:
  /// As load().
  const HeightmapFile& file(const std::string& path);

 private:
  struct Entry {
    std::string error;  ///< of a file that cannot be read: it may have taken long
    HeightmapFile file;
  };
  std::map<std::string, std::unique_ptr<Entry>> entries_;
};

}  // namespace muro::heightmap
