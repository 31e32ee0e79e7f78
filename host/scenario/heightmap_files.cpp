// SPDX-License-Identifier: MIT
#include "host/scenario/heightmap_files.hpp"

#include <fmt/format.h>

#include <cstring>

#include "core/error.hpp"
#include "muro/vocabulary/model.hpp"

namespace muro::host {

HeightmapFiles::File HeightmapFiles::read(const std::string& path) {
  File file;
  try {
    const RobotTree tree = simulation_.read_model(path);
    for (const RobotTree::Constant& c : tree.components().front().constants) {
      if (c.key.name == keys::heightmap_values.name && c.data.size() == c.count * sizeof(float)) {
        file.values.resize(c.count);
        std::memcpy(file.values.data(), c.data.data(), c.data.size());
      } else if (c.key.name == keys::heightmap_columns.name && c.data.size() == sizeof file.columns) {
        std::memcpy(&file.columns, c.data.data(), sizeof file.columns);
      }
    }
    if (file.columns < 2 || file.values.size() < 2 * std::size_t(file.columns))
      file.problem = fmt::format("{} is no heightmap", path);
  } catch (const SetupError& e) {
    file.problem = e.what();
    const std::string begin = "model " + path + ": ";  // the reader names the file already
    if (file.problem.starts_with(begin)) file.problem.erase(0, begin.size());
  }
  return file;
}

Heightmap HeightmapFiles::of(const std::string& path, const Vec3& size) {
  auto known = known_.find(path);
  if (known == known_.end()) known = known_.emplace(path, read(path)).first;
  const File& file = known->second;
  if (!file.problem.empty()) throw SetupError(file.problem);
  return {file.values, file.columns, std::uint32_t(file.values.size() / file.columns), size};
}

}  // namespace muro::host
