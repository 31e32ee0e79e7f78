// SPDX-License-Identifier: MIT
#pragma once

#include <deque>
#include <vector>

#include "lanes/terrain_grid.hpp"
#include "muro/scene.hpp"
#include "muro/toolkit/heightmap.hpp"

namespace muro::native {

/// A heightmap of the scenery at its place, with tiles that tell how steep and how even it is.
class Terrain {
 public:
  /// An edge between two triangles, or on the rim. Seen along it the triangle with `left` lies to the left.
  struct Edge {
    Vec3 from, to;     ///< m
    Vec3 left, right;  ///< unit normals; on the rim `right` is horizontal, outward
  };

  /// `map` is a view. `radius` (m): the farthest that a shape which may touch it reaches from its centre. [setup]
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
  /// Calls `visit(edge)` for the edges at -x and -y of a cell and that across it; at the rim also for the others.
  template <class Visit>
  void each_edge(Heightmap::Cell c, Visit visit) const {
    const Vec3 first = map_.node(c.column, c.row), right = map_.node(c.column + 1, c.row),
               left = map_.node(c.column, c.row + 1), last = map_.node(c.column + 1, c.row + 1);
    const Vec3 lower = normal(c, false), upper = normal(c, true);
    visit(Edge{first, right, lower, c.row > 0 ? normal({c.column, c.row - 1}, true) : outward(first, right)});
    visit(Edge{left, first, lower, c.column > 0 ? normal({c.column - 1, c.row}, true) : outward(left, first)});
    visit(Edge{right, left, lower, upper});
    if (c.row + 2 == map_.rows) visit(Edge{last, left, upper, outward(last, left)});
    if (c.column + 2 == map_.columns) visit(Edge{right, last, upper, outward(right, last)});
  }
  /// Whether a plane through a node with a unit normal touches the surface around it in that node alone.
  bool is_peak(std::uint32_t column, std::uint32_t row, const Vec3& normal) const;

  /// Unit, of a triangle.
  Vec3 normal(Heightmap::Cell c, bool upper) const {
    const Heightmap::Triangle t = map_.triangle(c, upper);
    return (t[1] - t[0]).cross(t[2] - t[0]).normalized();
  }

 private:
  /// Across an edge of the rim, horizontal.
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
