// SPDX-License-Identifier: MIT
#include "solid.hpp"

#include "heightmap_file.hpp"

namespace muro::heightmap {

bool contains(const Heightmap& h, const Vec3& point) {
  const auto ground = h.ground_at(point.x(), point.y());
  return ground && point.z() <= ground->height;
}

std::vector<Heightmap::Cell> rim_of(const Heightmap& h) {
  const std::uint32_t last_column = h.columns - 1, last_row = h.rows - 1;
  std::vector<Heightmap::Cell> rim;
  rim.reserve(2 * (std::size_t(last_column) + last_row));
  for (std::uint32_t column = 0; column < last_column; ++column) rim.push_back({column, 0});
  for (std::uint32_t row = 0; row < last_row; ++row) rim.push_back({last_column, row});
  for (std::uint32_t column = last_column; column > 0; --column) rim.push_back({column, last_row});
  for (std::uint32_t row = last_row; row > 0; --row) rim.push_back({0, row});
  return rim;
}

mesh::Mesh solid_mesh_of(const Heightmap& h) {
  mesh::Mesh mesh = mesh_of(h);
  const double floor = bounds_of(h).low.z();
  const std::vector<Heightmap::Cell> rim = rim_of(h);
  const auto first = std::uint32_t(mesh.vertices.size()), count = std::uint32_t(rim.size());
  for (const Heightmap::Cell& node : rim) {
    const Vec3 top = h.node(node.column, node.row);
    mesh.vertices.push_back({top.x(), top.y(), floor});
  }
  const auto top = [&](std::uint32_t i) { return rim[i].row * h.columns + rim[i].column; };
  for (std::uint32_t i = 0; i < count; ++i) {
    const std::uint32_t next = (i + 1) % count;
    mesh.triangles.push_back({top(i), first + i, first + next});
    mesh.triangles.push_back({top(i), first + next, top(next)});
  }
  // the floor as a fan of the nodes below the rim around its middle
  const auto middle = std::uint32_t(mesh.vertices.size());
  mesh.vertices.push_back({0, 0, floor});
  for (std::uint32_t i = 0; i < count; ++i) mesh.triangles.push_back({middle, first + (i + 1) % count, first + i});
  return mesh;
}

}  // namespace muro::heightmap
