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

/// Content of the file of a heightmap; see README.md.
struct HeightmapFile {
  std::span<const float> values;  ///< as Heightmap::values; in a picture 0 (black) to 1 (white)
  std::uint32_t columns = 0, rows = 0;
  std::shared_ptr<const void> owner{};  ///< of the values: all libraries of a program share those of one file

  /// Makes a file that owns these values.
  static HeightmapFile of(std::vector<float> values, std::uint32_t columns, std::uint32_t rows) {
    const auto owner = std::make_shared<const std::vector<float>>(std::move(values));
    return {*owner, columns, rows, owner};
  }

  /// Returns a heightmap that is valid as long as the values are.
  Heightmap heightmap(const Vec3& size) const { return {values, columns, rows, size}; }
};

/// Reads a file (absolute path). Throws muro::Error with the path if the file is missing, is not a heightmap or has
/// more nodes than 16384 x 16384. The file is read once while anybody has it, and again when it has changed. [setup]
HeightmapFile load(const std::string& path);

/// Depth (m) below the surface of a heightmap up to which bodies are pushed up.
inline constexpr double depth_of_ground = 1000;

/// Returns the bounds (m) of the surface.
Aabb bounds_of(const Heightmap& heightmap);

/// Returns the surface as triangles, two a cell, for users that know only meshes. It is an open mesh that faces up.
mesh::Mesh mesh_of(const Heightmap& heightmap);

/// A cache of files: each is read once, or fails once. References stay valid as long as the store lives. [setup]
class Store {
 public:
  /// Returns a file as load() does.
  const HeightmapFile& file(const std::string& path);

 private:
  struct Entry {
    std::string error;  ///< error of a file that cannot be read, since reading may have taken long
    HeightmapFile file;
  };
  std::map<std::string, std::unique_ptr<Entry>> entries_;
};

}  // namespace muro::heightmap
