// SPDX-License-Identifier: MIT
// Triangles of a heightmap below points, and the lines where two of them meet.
#pragma once

#include "float_rows.hpp"
#include "kernel_shape.hpp"
#include "terrain_grid.hpp"

namespace muro::native::lanes {
inline namespace MURO_ISA {

MURO_INLINE double value_of(double s, int) { return s; }
template <class S>
MURO_INLINE double value_of(const S& s, int i) {
  return s[i];
}
MURO_INLINE void set_value(double& s, int, double to) { s = to; }
template <class S>
MURO_INLINE void set_value(S& s, int i, double to) {
  s.set(i, to);
}

/// Lanes in which all conditions hold (all_of), or at least one does (any_of).
template <class M, class... Others>
MURO_INLINE M all_of(M first, Others... others) {
  if constexpr (std::is_same_v<M, bool>)
    return bool((int(first) & ... & int(others)));
  else
    return (first & ... & others);
}
template <class M, class... Others>
MURO_INLINE M any_of(M first, Others... others) {
  if constexpr (std::is_same_v<M, bool>)
    return bool((int(first) | ... | int(others)));
  else
    return (first | ... | others);
}

/// Slopes of a plane that is not upright. The upward vector across the plane is (-slope_x, -slope_y, 1).
template <class S>
struct Slopes {
  S x, y;

  MURO_INLINE V3<S> up() const { return {-x, -y, S(1)}; }
  /// Returns the square of the length of up().
  MURO_INLINE S up2() const { return S(1) + (x * x + y * y); }
  /// Returns the scalar product of up() and a vector.
  MURO_INLINE S along(const V3<S>& v) const { return v.z - (x * v.x + y * v.y); }
};

/// A triangle and its plane, in the frame of the heightmap.
template <class S>
struct Facet {
  S column, row;  ///< of its corner at the right angle
  S side;         ///< 1: the triangle lies at +x +y of that corner, -1: at -x -y
  V3<S> corner;   ///< m
  Slopes<S> slopes;

  /// Returns the height (m) of the plane above a point; negative if the plane is below the point.
  MURO_INLINE S rise_over(const V3<S>& p) const {
    return corner.z + (slopes.x * (p.x - corner.x) + slopes.y * (p.y - corner.y)) - p.z;
  }
  /// Returns the unit normal.
  MURO_INLINE V3<S> normal() const { return slopes.up() * (S(1) / sqrt(slopes.up2())); }
  /// Whether a point is over or under the triangle, or beside it by at most `slack` of the length of its sides.
  MURO_INLINE MaskOf<S> covers(const TerrainGrid& grid, S x, S y, double slack) const {
    const S a = side * (x - corner.x) * S(grid.per_spacing_x), b = side * (y - corner.y) * S(grid.per_spacing_y);
    return all_of(min(a, b) >= S(-slack), a + b <= S(1 + slack));
  }
  /// Returns a point inside the triangle (m).
  MURO_INLINE V3<S> inner_point(const TerrainGrid& grid) const {
    const S x = side * S(grid.spacing_x / 3), y = side * S(grid.spacing_y / 3);
    return {corner.x + x, corner.y + y, corner.z + (slopes.x * x + slopes.y * y)};
  }
  /// Returns a number that is unique among all triangles.
  MURO_INLINE S number(const TerrainGrid& grid) const { return side * (row * S(grid.columns) + column + S(1)); }
  MURO_INLINE MaskOf<S> is(const Facet& other) const {
    return all_of(column == other.column, row == other.row, side == other.side);
  }
  /// Whether both share an edge. Then one of them is at -x -y of the edge.
  MURO_INLINE MaskOf<S> is_beside(const Facet& other) const {
    const S x = (other.column - column) * side, y = (other.row - row) * side;
    return all_of(side + other.side == S(0), x >= S(0), y >= S(0), x <= S(1), y <= S(1), x + y >= S(1));
  }
};

template <class S>
MURO_INLINE Facet<S> select(MaskOf<S> m, const Facet<S>& a, const Facet<S>& b) {
  return {select(m, a.column, b.column),
          select(m, a.row, b.row),
          select(m, a.side, b.side),
          select(m, a.corner, b.corner),
          {select(m, a.slopes.x, b.slopes.x), select(m, a.slopes.y, b.slopes.y)}};
}

/// Returns `x` rounded down; `x` is from 0 to 2^31.
template <class S>
MURO_INLINE S floor_of(S x) {
  constexpr double shift = 0x1p52;
  const S rounded = (x + S(shift)) - S(shift);
  return rounded - select(rounded > x, S(1), S(0));
}

/// Returns the triangle of a cell at +x +y (`upper`) or the one at -x -y.
template <class S>
MURO_INLINE Facet<S> facet_of(const TerrainGrid& grid, S cell_column, S cell_row, MaskOf<S> upper) {
  Facet<S> f;
  f.side = select(upper, S(-1), S(1));
  const S is_upper = select(upper, S(1), S(0));
  f.column = cell_column + is_upper, f.row = cell_row + is_upper;
  S nodes[4];  // nodes of the cell, along x in both rows
  const float *const lower = grid.values, *const upper_row = grid.values + grid.columns;
  load_fours(
      cell_row * S(grid.columns) + cell_column,
      [=](std::int64_t node) { return two_and_two(lower + node, upper_row + node); }, nodes);
  // the corner, and its neighbours along x and y
  const S corner = select(upper, nodes[3], nodes[0]), beside = select(upper, nodes[2], nodes[1]),
          above = select(upper, nodes[1], nodes[2]);
  f.corner = {f.column * S(grid.spacing_x) - S(grid.half_x), f.row * S(grid.spacing_y) - S(grid.half_y),
              S(grid.scale) * corner};
  f.slopes = {(beside - corner) * (f.side * S(grid.scale * grid.per_spacing_x)),
              (above - corner) * (f.side * S(grid.scale * grid.per_spacing_y))};
  return f;
}

/// Returns `x` limited to 0 and a number just below `end`; 0 if `x` is not a number.
template <class S>
MURO_INLINE S clamped(S x, int end) {
  return min(max(x, S(0)), S(end * (1 - 0x1p-53)));
}

/// Returns the triangle over or under a point; if the point is beyond the rim, a triangle near it.
template <class S>
MURO_INLINE Facet<S> facet_at(const TerrainGrid& grid, S x, S y) {
  const S u = clamped<S>((x + S(grid.half_x)) * S(grid.per_spacing_x), grid.columns - 1),
          v = clamped<S>((y + S(grid.half_y)) * S(grid.per_spacing_y), grid.rows - 1);
  const S column = floor_of(u), row = floor_of(v);
  return facet_of<S>(grid, column, row, (u - column) + (v - row) > S(1));
}

/// Slopes near a shape, taken from a tile.
template <class S>
struct NearSlopes {
  Slopes<S> slopes;  ///< of the plane of the tile
  S rise;            ///< m, of that plane over the centre
  S spread;
};

/// `centre` (m): of a shape that reaches no farther than the level.
template <class S>
MURO_INLINE NearSlopes<S> slopes_near(const TerrainGrid& grid, const TerrainLevel& level, const V3<S>& centre) {
  const S u = clamped<S>((centre.x + S(grid.half_x)) * S(level.per_x), level.columns),
          v = clamped<S>((centre.y + S(grid.half_y)) * S(level.per_y), level.rows);
  const S column = floor_of(u), row = floor_of(v);
  static_assert(sizeof(TerrainTile) == 4 * sizeof(float));
  const float* const numbers = &level.tiles->height;
  S tile[4];  // members of a TerrainTile, in their order
  load_fours(
      row * S(4 * level.columns) + S(4) * column, [&](std::int64_t at) { return four_at(numbers + at); }, tile);
  const S x = centre.x + S(grid.half_x) - (column + S(0.5)) * S(level.length_x),
          y = centre.y + S(grid.half_y) - (row + S(0.5)) * S(level.length_y);
  return {{tile[1], tile[2]}, tile[0] + (tile[1] * x + tile[2] * y) - centre.z, tile[3]};
}

}  // namespace MURO_ISA
}  // namespace muro::native::lanes
