// SPDX-License-Identifier: MIT
// The surface of a heightmap, in the frame of its shape.
#pragma once

#include <algorithm>
#include <array>
#include <optional>
#include <span>

#include "muro/geometry.hpp"

namespace muro {

/// Heights over the nodes of a regular grid in x and y, centred on the origin. Each cell of the grid is two triangles,
/// divided from its corner at +x -y to that at -x +y, as in Bullet, ODE and MuJoCo. It is solid below the surface;
/// beyond the rim of the grid there is nothing. A view: the reader of the file keeps the values.
struct Heightmap {
  /// Rows from -y to +y, each from -x to +x; finite.
  std::span<const float> values;
  std::uint32_t columns = 0, rows = 0;  ///< number of nodes along x and y, 2 or more
  /// m: full lengths in x and y, and the height of a value of 1.
  Vec3 size = Vec3::Zero();

  /// A point of the surface, and the unit normal of its triangle (upward).
  struct Ground {
    double height;  ///< m
    Vec3 normal;
  };
  struct Cell {
    std::uint32_t column, row;
  };
  /// Corners (m), counter-clockwise seen from above.
  using Triangle = std::array<Vec3, 3>;

  double spacing_x() const { return size.x() / (columns - 1); }
  double spacing_y() const { return size.y() / (rows - 1); }

  /// Position (m) of the node of a column and a row.
  Vec3 node(std::uint32_t column, std::uint32_t row) const {
    return {column * spacing_x() - 0.5 * size.x(), row * spacing_y() - 0.5 * size.y(),
            size.z() * double(values[std::size_t(row) * columns + column])};
  }

  bool covers(double x, double y) const { return std::abs(x) <= 0.5 * size.x() && std::abs(y) <= 0.5 * size.y(); }

  /// Returns the cell over or under a point; beyond the rim, the nearest cell.
  Cell cell_at(double x, double y) const {
    const auto number = [](double at, std::uint32_t nodes) {
      return at > 0 ? std::uint32_t(std::min(at, double(nodes - 2))) : 0;  // 0 for NaN
    };
    return {number((x + 0.5 * size.x()) / spacing_x(), columns), number((y + 0.5 * size.y()) / spacing_y(), rows)};
  }

  /// Returns the triangle of a cell at its corner -x -y (`upper`: false) or +x +y.
  Triangle triangle(Cell c, bool upper) const {
    const Vec3 right = node(c.column + 1, c.row), left = node(c.column, c.row + 1);
    if (upper) return {node(c.column + 1, c.row + 1), left, right};
    return {node(c.column, c.row), right, left};
  }

  /// Whether a point of a cell is over or under its triangle at +x +y.
  bool is_upper(Cell c, double x, double y) const {
    const double u = (x + 0.5 * size.x()) / spacing_x() - c.column, v = (y + 0.5 * size.y()) / spacing_y() - c.row;
    return u + v > 1;
  }

  /// Returns the surface over or under a point; empty beyond the rim.
  std::optional<Ground> ground_at(double x, double y) const {
    if (!covers(x, y)) return std::nullopt;
    const Cell cell = cell_at(x, y);
    const Triangle t = triangle(cell, is_upper(cell, x, y));
    const Vec3 normal = (t[1] - t[0]).cross(t[2] - t[0]).normalized();
    return Ground{t[0].z() - (normal.x() * (x - t[0].x()) + normal.y() * (y - t[0].y())) / normal.z(), normal};
  }
};

}  // namespace muro
