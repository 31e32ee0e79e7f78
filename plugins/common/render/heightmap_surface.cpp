// SPDX-License-Identifier: MIT
#include "heightmap_surface.hpp"

#include <algorithm>

#include "plugins/common/heightmap/heightmap_file.hpp"
#include "plugins/common/heightmap/solid.hpp"

namespace muro::render {

namespace {

constexpr std::uint32_t cells_of_a_part = 128;  ///< in each direction

/// Returns the normal at a node, by the heights of the nodes beside it.
Vec3 normal_at(const Heightmap& h, std::uint32_t column, std::uint32_t row) {
  const std::uint32_t left = column - (column > 0), right = column + (column + 1 < h.columns);
  const std::uint32_t down = row - (row > 0), up = row + (row + 1 < h.rows);
  const Vec3 across = h.node(right, row) - h.node(left, row), along = h.node(column, up) - h.node(column, down);
  return across.cross(along).normalized();
}

Vertex vertex_at(const Heightmap& h, std::uint32_t column, std::uint32_t row, const Vec3& position,
                 const Vec3& normal) {
  Vertex v;
  for (std::size_t k = 0; k < 3; ++k) {
    v.position[k] = float(position[Eigen::Index(k)]);
    v.normal[k] = float(normal[Eigen::Index(k)]);
  }
  v.texture_coordinates = {float(column) / float(h.columns - 1), 1 - float(row) / float(h.rows - 1)};
  return v;
}

/// Makes a part of the cells from (column, row) up to, and without, (column_end, row_end).
HeightmapPart ground_part(const Heightmap& h, std::uint32_t column, std::uint32_t row, std::uint32_t column_end,
                          std::uint32_t row_end) {
  HeightmapPart part;
  part.centre = 0.5 * (h.node(column, row) + h.node(column_end, row_end));
  const std::uint32_t wide = column_end - column + 1;
  part.surface.vertices.reserve(std::size_t(wide) * (row_end - row + 1));
  for (std::uint32_t r = row; r <= row_end; ++r)
    for (std::uint32_t c = column; c <= column_end; ++c)
      part.surface.vertices.push_back(vertex_at(h, c, r, h.node(c, r) - part.centre, normal_at(h, c, r)));
  part.surface.indices.reserve(std::size_t(6) * (wide - 1) * (row_end - row));
  for (std::uint32_t r = 0; r < row_end - row; ++r)
    for (std::uint32_t c = 0; c + 1 < wide; ++c) {
      const std::uint32_t first = r * wide + c, left = first + wide;
      part.surface.indices.insert(part.surface.indices.end(), {first, first + 1, left, left + 1, left, first + 1});
    }
  return part;
}

HeightmapPart walls_and_floor(const Heightmap& h) {
  const double floor = heightmap::bounds_of(h).low.z();
  HeightmapPart part;
  part.centre = {0, 0, floor};
  Surface& s = part.surface;
  const std::vector<Heightmap::Cell> rim = heightmap::rim_of(h);
  for (std::size_t i = 0; i < rim.size(); ++i) {
    const Heightmap::Cell ends[] = {rim[i], rim[(i + 1) % rim.size()]};
    const Vec3 top[] = {h.node(ends[0].column, ends[0].row), h.node(ends[1].column, ends[1].row)};
    const Vec3 along = top[1] - top[0], outward = Vec3(along.y(), -along.x(), 0).normalized();
    const auto first = std::uint32_t(s.vertices.size());
    for (std::size_t k = 0; k < 2; ++k)
      for (const double z : {top[k].z() - floor, 0.0})
        s.vertices.push_back(vertex_at(h, ends[k].column, ends[k].row, {top[k].x(), top[k].y(), z}, outward));
    s.indices.insert(s.indices.end(), {first, first + 1, first + 3, first, first + 3, first + 2});
  }
  const auto middle = std::uint32_t(s.vertices.size()), count = std::uint32_t(rim.size());
  s.vertices.push_back(vertex_at(h, h.columns / 2, h.rows / 2, Vec3::Zero(), -Vec3::UnitZ()));
  for (const Heightmap::Cell& node : rim) {
    const Vec3 top = h.node(node.column, node.row);
    s.vertices.push_back(vertex_at(h, node.column, node.row, {top.x(), top.y(), 0}, -Vec3::UnitZ()));
  }
  for (std::uint32_t i = 0; i < count; ++i)
    s.indices.insert(s.indices.end(), {middle, middle + 1 + (i + 1) % count, middle + 1 + i});
  return part;
}

}  // namespace

std::vector<HeightmapPart> parts_of(const Heightmap& h) {
  std::vector<HeightmapPart> parts;
  for (std::uint32_t row = 0; row + 1 < h.rows; row += cells_of_a_part)
    for (std::uint32_t column = 0; column + 1 < h.columns; column += cells_of_a_part)
      parts.push_back(ground_part(h, column, row, std::min(column + cells_of_a_part, h.columns - 1),
                                  std::min(row + cells_of_a_part, h.rows - 1)));
  parts.push_back(walls_and_floor(h));
  return parts;
}

}  // namespace muro::render
