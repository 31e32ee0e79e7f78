// SPDX-License-Identifier: MIT
#include "terrain/terrain.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "muro/base/elementary.hpp"

namespace muro::native {
namespace {

/// Relative rounding of heights of the file, which are numbers of 24 bits, and of their sums.
constexpr double rounding = 1e-6;
constexpr std::size_t max_tiles = std::size_t(1) << 22;

struct Interval {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  void include(double x) { low = std::min(low, x), high = std::max(high, x); }
  double middle() const { return 0.5 * (low + high); }
};

/// Cells from `begin` to before `end`.
struct Cells {
  std::uint32_t begin_column, end_column, begin_row, end_row;
};

std::uint32_t clamped(std::int64_t cell, std::uint32_t nodes) {
  return std::uint32_t(std::clamp<std::int64_t>(cell, 0, std::int64_t(nodes) - 1));
}

/// Makes the tile over cells. `x`, `y` (m): the middle of the tile.
TerrainTile tile_over(const Heightmap& map, const Cells& cells, double x, double y) {
  Interval slopes_x, slopes_y;
  const double per_x = map.size.z() / map.spacing_x(), per_y = map.size.z() / map.spacing_y();
  const auto value = [&](std::uint32_t column, std::uint32_t row) {
    return double(map.values[std::size_t(row) * map.columns + column]);
  };
  for (std::uint32_t r = cells.begin_row; r < cells.end_row; ++r)
    for (std::uint32_t c = cells.begin_column; c < cells.end_column; ++c) {
      const double first = value(c, r), right = value(c + 1, r), left = value(c, r + 1), last = value(c + 1, r + 1);
      slopes_x.include((right - first) * per_x), slopes_x.include((last - left) * per_x);
      slopes_y.include((left - first) * per_y), slopes_y.include((last - right) * per_y);
    }
  const auto slope_x = float(slopes_x.middle()), slope_y = float(slopes_y.middle());
  const double off_x = std::max(slopes_x.high - double(slope_x), double(slope_x) - slopes_x.low),
               off_y = std::max(slopes_y.high - double(slope_y), double(slope_y) - slopes_y.low);
  double height = -std::numeric_limits<double>::infinity(), largest = 0;
  for (std::uint32_t r = cells.begin_row; r <= cells.end_row; ++r)
    for (std::uint32_t c = cells.begin_column; c <= cells.end_column; ++c) {
      const Vec3 node = map.node(c, r);
      height = std::max(height, node.z() - double(slope_x) * (node.x() - x) - double(slope_y) * (node.y() - y));
      largest = std::max(largest, std::abs(node.z()));
    }
  return {float(height + rounding * (1e-3 + largest + std::abs(height))), slope_x, slope_y,
          float((1 + rounding) * elementary::hypot(off_x, off_y))};
}

}  // namespace

Terrain::Terrain(const Heightmap& map, const Pose& pose, double radius) : map_(map), pose_(pose) {
  grid_.values = map.values.data();
  grid_.columns = int(map.columns), grid_.rows = int(map.rows);
  grid_.half_x = 0.5 * map.size.x(), grid_.half_y = 0.5 * map.size.y();
  grid_.spacing_x = map.spacing_x(), grid_.spacing_y = map.spacing_y();
  grid_.per_spacing_x = 1 / grid_.spacing_x, grid_.per_spacing_y = 1 / grid_.spacing_y;
  grid_.scale = map.size.z();
  const Mat3 axes = pose.orientation.toRotationMatrix();
  Mat3::Map(grid_.axes) = axes;
  Vec3::Map(grid_.origin) = pose.position;
  grid_.is_turned = axes != Mat3::Identity();
  for (double reach = std::max(grid_.spacing_x, grid_.spacing_y);
       grid_.level_count < TerrainGrid::max_levels && !grid_.level_for(radius); reach *= 2)
    add_level(reach);
}

void Terrain::add_level(double reach) {
  const auto cells_in = [reach](double spacing, std::uint32_t nodes) {
    return std::int64_t(std::min(std::ceil(reach / spacing * (1 - 1e-9)), double(nodes)));
  };
  const std::int64_t cells_x = cells_in(grid_.spacing_x, map_.columns), cells_y = cells_in(grid_.spacing_y, map_.rows);
  const auto columns = (std::int64_t(map_.columns) - 2) / cells_x + 1,
             rows = (std::int64_t(map_.rows) - 2) / cells_y + 1;
  if (std::size_t(columns) * std::size_t(rows) > max_tiles) return;
  TerrainLevel level;
  level.columns = int(columns), level.rows = int(rows);
  level.length_x = double(cells_x) * grid_.spacing_x, level.length_y = double(cells_y) * grid_.spacing_y;
  level.per_x = 1 / level.length_x, level.per_y = 1 / level.length_y;
  level.reach = reach * (1 - 1e-6);
  std::vector<TerrainTile>& tiles = tiles_.emplace_back();
  tiles.reserve(std::size_t(columns) * std::size_t(rows));
  for (std::int64_t r = 0; r < rows; ++r)
    for (std::int64_t c = 0; c < columns; ++c) {
      const Cells cells{clamped((c - 1) * cells_x, map_.columns), clamped((c + 2) * cells_x, map_.columns),
                        clamped((r - 1) * cells_y, map_.rows), clamped((r + 2) * cells_y, map_.rows)};
      tiles.push_back(tile_over(map_, cells, (double(c) + 0.5) * level.length_x - grid_.half_x,
                                (double(r) + 0.5) * level.length_y - grid_.half_y));
    }
  level.tiles = tiles.data();
  grid_.levels[grid_.level_count++] = level;
}

bool Terrain::is_peak(std::uint32_t column, std::uint32_t row, const Vec3& normal) const {
  constexpr double least_fall = 1e-4;  // as a part of the length of an edge
  constexpr int ways[6][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, -1}, {-1, 1}};
  const Vec3 node = map_.node(column, row);
  for (const auto& [x, y] : ways) {
    const std::int64_t c = std::int64_t(column) + x, r = std::int64_t(row) + y;
    if (c < 0 || r < 0 || c >= map_.columns || r >= map_.rows) continue;
    const Vec3 edge = map_.node(std::uint32_t(c), std::uint32_t(r)) - node;
    if (edge.dot(normal) > -least_fall * edge.norm()) return false;
  }
  return true;
}

}  // namespace muro::native
