// SPDX-License-Identifier: MIT
// Heightmaps, read by the parser process.
#include "heightmap_file.hpp"

#include <sys/stat.h>

#include <cmath>
#include <cstring>
#include <filesystem>

#include "muro/algorithm.hpp"
#include "plugins/common/parser_process/ask.hpp"

namespace muro::heightmap {

namespace process = parser_process;

namespace {

/// Returns a text that changes with the file.
std::string version_of(const std::filesystem::path& path) {
  struct stat file {};
  if (::stat(path.c_str(), &file) != 0) return "";
  std::string version;
  for (const std::int64_t number : {std::int64_t(file.st_dev), std::int64_t(file.st_ino), std::int64_t(file.st_size),
                                    std::int64_t(file.st_mtim.tv_sec), std::int64_t(file.st_mtim.tv_nsec),
                                    std::int64_t(file.st_ctim.tv_sec), std::int64_t(file.st_ctim.tv_nsec)})
    version += std::to_string(number) + " ";
  return version;
}

/// Reads the answer of heightmap_service.cpp in place: columns and rows, the number of values, the values.
HeightmapFile file_in(process::SharedBytes answer) {
  struct Header {
    std::uint32_t columns, rows;
    std::uint64_t values;
  } header{};
  if (answer.bytes.size() < sizeof header) throw Error("a heightmap of the parser process is cut short");
  std::memcpy(&header, answer.bytes.data(), sizeof header);
  const std::uint64_t nodes = std::uint64_t(header.columns) * header.rows;
  if (header.columns < 2 || header.rows < 2 || header.values != nodes ||
      answer.bytes.size() != sizeof header + nodes * sizeof(float))
    throw Error("a heightmap of the parser process has not as many values as nodes");
  const std::span values(reinterpret_cast<const float*>(answer.bytes.data() + sizeof header), nodes);
  for (const float value : values)
    if (!std::isfinite(value)) throw Error("a heightmap of the parser process has values that are not finite");
  return {values, header.columns, header.rows, std::move(answer.owner)};
}

}  // namespace

HeightmapFile load(const std::string& path) {
  std::error_code code;
  std::filesystem::path absolute = std::filesystem::absolute(path, code);
  if (code) absolute = path;
  process::Writer request;
  request.text(absolute.string());
  return file_in(
      process::ask_shared({.service = "heightmap",
                           .subject = "heightmap " + path,
                           .needs = "libstb-dev",
                           .advice = "the file is probably damaged: write it anew as a grey PNG file of 8 or 16 bits"},
                          request.bytes(), version_of(absolute)));
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
