// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <vector>

#include "lanes/terrain_grid.hpp"
#include "muro/scene.hpp"
#include "muro/toolkit/heightmap.hpp"

namespace muro::native {

/// A heightmap of the scenery at its pose, with tiles that describe how steep and how even it is.
class Terrain {
 public:
  /// `map` is a view. `radius` (m): the farthest reach from its centre of a shape that may touch it. [setup]
  Terrain(const Heightmap& map, const Pose& pose, double radius);
  Terrain(const Terrain&) = delete;
  Terrain& operator=(const Terrain&) = delete;

  const TerrainGrid& grid() const { return grid_; }
  const Heightmap& map() const { return map_; }
  const Pose& pose() const { return pose_; }

  /// Calls `visit(cell)` for the cells below a box, row by row.
  template <class Visit>
  void each_cell(const Aabb& box, Visit visit) const {
    if (box.low.x() > grid_.half_x || box.high.x() < -grid_.half_x) return;
    if (box.low.y() > grid_.half_y || box.high.y() < -grid_.half_y) return;
    const Heightmap::Cell first = map_.cell_at(box.low.x(), box.low.y()),
                          last = map_.cell_at(box.high.x(), box.high.y());
    for (std::uint32_t row = first.row; row <= last.row; ++row)
      for (std::uint32_t column = first.column; column <= last.column; ++column) visit(Heightmap::Cell{column, row});
  }
  /// Calls `visit(from, to, left, right)` for the edges at -x and -y of a cell and the edge across it, and at the rim
  /// also for the other edges. Seen along an edge, the triangle with `left` lies to the left. `side_of(cell, upper)`
  /// returns `left` and `right`. On the rim, `beyond(normal)` returns `right`, for a horizontal outward unit normal.
  /// Edges that do not rise between their triangles are omitted, and those for which `is_near(from, to)` is false.
  template <class IsNear, class SideOf, class Beyond, class Visit>
  void each_edge(Heightmap::Cell c, IsNear is_near, SideOf side_of, Beyond beyond, Visit visit) const {
    const Vec3 first = map_.node(c.column, c.row), right = map_.node(c.column + 1, c.row),
               left = map_.node(c.column, c.row + 1), last = map_.node(c.column + 1, c.row + 1);
    const auto on_rim = [&](const Vec3& from, const Vec3& to, bool upper) {
      if (!is_near(from, to)) return;
      const auto outside = beyond(outward(from, to));
      visit(from, to, side_of(c, upper), outside);
    };
    // whether the nodes of an edge lie higher than the two nodes beside it
    const auto rises = [](const Vec3& from, const Vec3& to, const Vec3& a, const Vec3& b) {
      return from.z() + to.z() > a.z() + b.z();
    };
    if (c.row == 0)
      on_rim(first, right, false);
    else if (rises(first, right, left, map_.node(c.column + 1, c.row - 1)) && is_near(first, right))
      visit(first, right, side_of(c, false), side_of(Heightmap::Cell{c.column, c.row - 1}, true));
    if (c.column == 0)
      on_rim(left, first, false);
    else if (rises(left, first, right, map_.node(c.column - 1, c.row + 1)) && is_near(left, first))
      visit(left, first, side_of(c, false), side_of(Heightmap::Cell{c.column - 1, c.row}, true));
    if (rises(right, left, first, last) && is_near(right, left))
      visit(right, left, side_of(c, false), side_of(c, true));
    if (c.row + 2 == map_.rows) on_rim(last, left, true);
    if (c.column + 2 == map_.columns) on_rim(right, last, true);
  }
  /// Whether a plane through a node with a unit normal touches the surface around it in that node alone.
  bool is_peak(std::uint32_t column, std::uint32_t row, const Vec3& normal) const;

  /// Returns the unit normal of a triangle.
  Vec3 normal(Heightmap::Cell c, bool upper) const {
    const Heightmap::Triangle t = map_.triangle(c, upper);
    return (t[1] - t[0]).cross(t[2] - t[0]).normalized();
  }

 private:
  /// Returns the horizontal unit normal of an edge of the rim, outward.
  static Vec3 outward(const Vec3& from, const Vec3& to) {
    return Vec3(to.y() - from.y(), from.x() - to.x(), 0).normalized();
  }
  void add_level(double reach);

  Heightmap map_;
  Pose pose_;
  TerrainGrid grid_;
  std::deque<std::vector<TerrainTile>> tiles_;  ///< by level
};

}  // namespace muro::native
