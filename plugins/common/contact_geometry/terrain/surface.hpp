// SPDX-License-Identifier: MIT
// Triangles, edges and nodes of a heightmap near a shape.
#pragma once

#include <algorithm>

#include "muro/scene.hpp"
#include "muro/toolkit/heightmap.hpp"

namespace muro::terrain_contact {

/// An edge of the surface, with the directions to its sides.
struct SurfaceEdge {
  Vec3 begin, end;  ///< m
  Vec3 inward[2];   ///< unit: from the edge into its triangles, at right angles to it; at a rim both are equal
  Vec3 normal;      ///< unit: between those of its triangles
  std::uint32_t first[2], second[2];  ///< column and row of its nodes

  /// Whether a shape that is pushed along `n` (unit) moves away from both triangles.
  bool allows(const Vec3& n) const {
    constexpr double slack = 1e-3;
    return n.z() > 0 && n.dot(inward[0]) <= slack && n.dot(inward[1]) <= slack;
  }
};

class Surface {
 public:
  explicit Surface(const Heightmap& map) : map_(map) {}
  const Heightmap& map() const { return map_; }

  struct Triangle {
    Heightmap::Triangle corners;
    Vec3 normal;
    Heightmap::Cell cell;
    bool upper;
    double height_of(const Vec3& p) const { return normal.dot(p - corners[0]); }
  };

  /// Whether a point is over or under the triangle, or at most `slack` (m) beside it.
  bool covers(const Triangle& t, const Vec3& p, double slack) const {
    const double du = slack / map_.spacing_x(), dv = slack / map_.spacing_y();
    const double u = (p.x() + 0.5 * map_.size.x()) / map_.spacing_x() - t.cell.column,
                 v = (p.y() + 0.5 * map_.size.y()) / map_.spacing_y() - t.cell.row;
    if (t.upper) return u <= 1 + du && v <= 1 + dv && u + v >= 1 - du - dv;
    return u >= -du && v >= -dv && u + v <= 1 + du + dv;
  }

  /// Calls `visit(triangle)` for triangles that a box may touch, or that are over it.
  template <class Visit>
  void each_triangle(const Aabb& box, Visit visit) const {
    each_cell(box, [&](Heightmap::Cell c) {
      for (const bool upper : {false, true}) visit(triangle(c, upper));
    });
  }

  /// Calls `visit(edge)` for edges near a box that stand out: the surface falls away, or ends, on both sides.
  template <class Visit>
  void each_ridge(const Aabb& box, Visit visit) const {
    each_cell(box, [&](Heightmap::Cell c) {
      const auto& [i, j] = c;
      const Vec3 a = map_.node(i, j), right = map_.node(i + 1, j), left = map_.node(i, j + 1),
                 b = map_.node(i + 1, j + 1);
      const auto near = [&](const Vec3& p, const Vec3& q) {
        return std::max(p.z(), q.z()) >= box.low.z() && std::min(p.z(), q.z()) <= box.high.z();
      };
      const auto ridge = [&](const Vec3& p, std::uint32_t pi, std::uint32_t pj, const Vec3& q, std::uint32_t qi,
                             std::uint32_t qj, const Vec3* one, const Vec3* other) {
        // compares the middle of the edge with that of the corners to its sides, which is at the same place of the map
        if (other && p.z() + q.z() <= one->z() + other->z()) return;
        SurfaceEdge edge{p, q, {}, {}, {pi, pj}, {qi, qj}};
        if (near(p, q) && stands_out(edge, one, other)) visit(edge);
      };
      ridge(right, i + 1, j, left, i, j + 1, &a, &b);
      const Vec3 below = j > 0 ? map_.node(i + 1, j - 1) : Vec3(), beside = i > 0 ? map_.node(i - 1, j + 1) : Vec3();
      ridge(a, i, j, right, i + 1, j, &left, j > 0 ? &below : nullptr);
      ridge(a, i, j, left, i, j + 1, &right, i > 0 ? &beside : nullptr);
      if (j + 2 == map_.rows) ridge(left, i, j + 1, b, i + 1, j + 1, &right, nullptr);
      if (i + 2 == map_.columns) ridge(right, i + 1, j, b, i + 1, j + 1, &left, nullptr);
    });
  }

  /// Calls `visit(column, row)` for the nodes near a box.
  template <class Visit>
  void each_node(const Aabb& box, Visit visit) const {
    each_cell(box, [&](Heightmap::Cell c) {
      visit(c.column, c.row);
      const bool last_column = c.column + 2 == map_.columns, last_row = c.row + 2 == map_.rows;
      if (last_column) visit(c.column + 1, c.row);
      if (last_row) visit(c.column, c.row + 1);
      if (last_column && last_row) visit(c.column + 1, c.row + 1);
    });
  }

  /// Whether a shape that a node pushes along `n` (unit) moves away from all triangles about the node.
  bool allows(std::uint32_t column, std::uint32_t row, const Vec3& n) const {
    constexpr double slack = 1e-3;
    constexpr int neighbours[6][2] = {{1, 0}, {-1, 0}, {0, 1}, {0, -1}, {1, -1}, {-1, 1}};
    const Vec3 node = map_.node(column, row);
    for (const auto& [x, y] : neighbours) {
      const std::int64_t i = std::int64_t(column) + x, j = std::int64_t(row) + y;
      if (i < 0 || j < 0 || i >= map_.columns || j >= map_.rows) continue;
      const Vec3 side = map_.node(std::uint32_t(i), std::uint32_t(j)) - node;
      if (n.dot(side) > slack * side.norm()) return false;
    }
    return n.z() > 0;
  }

 private:
  /// Angle (rad) between two triangles below which their edge is flat.
  static constexpr double flat = 1e-4;

  Triangle triangle(Heightmap::Cell c, bool upper) const {
    const Heightmap::Triangle t = map_.triangle(c, upper);
    return {t, (t[1] - t[0]).cross(t[2] - t[0]).normalized(), c, upper};
  }

  template <class Visit>
  void each_cell(const Aabb& box, Visit visit) const {
    const double half_x = 0.5 * map_.size.x(), half_y = 0.5 * map_.size.y();
    if (box.high.x() < -half_x || box.low.x() > half_x || box.high.y() < -half_y || box.low.y() > half_y) return;
    const Heightmap::Cell first = map_.cell_at(box.low.x(), box.low.y()),
                          last = map_.cell_at(box.high.x(), box.high.y());
    const double low = box.low.z();
    for (std::uint32_t j = first.row; j <= last.row; ++j)
      for (std::uint32_t i = first.column; i <= last.column; ++i)
        if (height(i, j) >= low || height(i + 1, j) >= low || height(i, j + 1) >= low || height(i + 1, j + 1) >= low)
          visit(Heightmap::Cell{i, j});
  }
  double height(std::uint32_t column, std::uint32_t row) const {
    return map_.size.z() * double(map_.values[std::size_t(row) * map_.columns + column]);
  }

  /// Sets the sides of an edge. Returns whether it stands out. `one`, `other`: third corners of its triangles; null:
  /// rim.
  static bool stands_out(SurfaceEdge& edge, const Vec3* one, const Vec3* other) {
    const Vec3 along = (edge.end - edge.begin).normalized();
    const auto into = [&](const Vec3& corner) {
      const Vec3 side = corner - edge.begin;
      return Vec3((side - along.dot(side) * along).normalized());
    };
    const auto upward = [&](const Vec3& inward) {
      const Vec3 n = along.cross(inward);
      return n.z() < 0 ? Vec3(-n) : n;
    };
    edge.inward[0] = edge.inward[1] = into(*one);
    edge.normal = upward(edge.inward[0]);
    if (!other) return true;
    edge.inward[1] = into(*other);
    if (edge.normal.dot(edge.inward[1]) > -flat) return false;
    edge.normal = (edge.normal + upward(edge.inward[1])).normalized();
    return true;
  }

  const Heightmap& map_;
};

}  // namespace muro::terrain_contact
