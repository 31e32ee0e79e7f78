// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "core/simulation.hpp"
#include "muro/toolkit/heightmap.hpp"

namespace muro::host {

/// Files of heightmaps, for placement: each is read once, by the reader for its type (reader.heightmap).
class HeightmapFiles {
 public:
  explicit HeightmapFiles(Simulation& simulation) : simulation_(simulation) {}

  /// Returns a view of the file's values, valid while this object lives. Throws SetupError when the file cannot be
  /// read, or is no heightmap.
  Heightmap of(const std::string& path, const Vec3& size);

 private:
  struct File {
    std::vector<float> values;
    std::uint32_t columns = 0;
    std::string problem;
  };
  File read(const std::string& path);

  Simulation& simulation_;
  std::map<std::string, File> known_;
};

}  // namespace muro::host
