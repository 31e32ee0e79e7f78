// SPDX-License-Identifier: MIT
// Heightmaps, read by the parser process.
#include "heightmap_file.hpp"

#include <cmath>
#include <filesystem>

#include "muro/algorithm.hpp"
#include "plugins/common/parser_process/ask.hpp"

namespace muro::heightmap {

namespace process = parser_process;

HeightmapFile load(const std::string& path) {
  std::error_code code;
  const std::filesystem::path absolute = std::filesystem::absolute(path, code);
  process::Writer request;
  request.text(code ? path : absolute.string());
  const process::Answer answer =
      process::ask({.service = "heightmap",
                    .subject = "heightmap " + path,
                    .needs = "libstb-dev",
                    .advice = "the file is probably damaged: write it anew as a grey PNG file of 8 or 16 bits"},
                   request.bytes());
  process::Reader reader = answer.reader();
  HeightmapFile file;
  file.columns = reader.value<std::uint32_t>();
  file.rows = reader.value<std::uint32_t>();
  file.values = reader.list<float>();
  if (file.columns < 2 || file.rows < 2 || file.values.size() != std::size_t(file.columns) * file.rows)
    throw Error("a heightmap of the parser process has not as many values as nodes");
  for (const float value : file.values)
    if (!std::isfinite(value)) throw Error("a heightmap of the parser process has values that are not finite");
  return file;
}

Aabb bounds_of(const Heightmap& h) {
  const auto [low, high] = std::minmax_element(h.values.begin(), h.values.end());
  return {{-0.5 * h.size.x(), -0.5 * h.size.y(), h.size.z() * double(*low)},
          {0.5 * h.size.x(), 0.5 * h.size.y(), h.size.z() * double(*high)}};
}

mesh::Mesh mesh_of(const Heightmap& h) {
  mesh::Mesh mesh;
  mesh.vertices.reserve(h.values.size());
  mesh.triangles.reserve(2 * std::size_t(h.columns - 1) * (h.rows - 1));
  for (std::uint32_t row = 0; row < h.rows; ++row)
    for (std::uint32_t column = 0; column < h.columns; ++column) mesh.vertices.push_back(h.node(column, row));
  for (std::uint32_t row = 0; row + 1 < h.rows; ++row)
    for (std::uint32_t column = 0; column + 1 < h.columns; ++column) {
      const std::uint32_t first = row * h.columns + column, right = first + 1, left = first + h.columns;
      mesh.triangles.push_back({first, right, left});
      mesh.triangles.push_back({left + 1, left, right});
    }
  return mesh;
}

const HeightmapFile& Store::file(const std::string& path) {
  std::unique_ptr<Entry>& entry = entries_[path];
  if (!entry) {
    auto read = std::make_unique<Entry>();
    try {
      read->file = load(path);
    } catch (const Error& error) {
      read->error = error.what();
    }
    entry = std::move(read);
  }
  if (!entry->error.empty()) throw Error(entry->error);
  return entry->file;
}

}  // namespace muro::heightmap
