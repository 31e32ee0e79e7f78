// SPDX-License-Identifier: MIT
// The triangles of a heightmap below points, and where two of them meet.
#pragma once

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

/// Where all conditions hold; where one does.
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

/// A triangle and its plane, in the frame of the heightmap.
template <class S>
struct Facet {
  S column, row;  ///< of its corner at the right angle
  S side;         ///< 1: the rest of it is at +x +y of that corner, -1: at -x -y
  V3<S> corner;   ///< m
  S slope_x, slope_y;
  V3<S> normal;  ///< unit, upward

  /// How deep (m) a point lies below the plane.
  MURO_INLINE S depth_of(const V3<S>& p) const {
    return (corner.z + (slope_x * (p.x - corner.x) + slope_y * (p.y - corner.y)) - p.z) * normal.z;
  }
  /// Whether a point is over or under the triangle, or beside it by `slack` of the length of its sides at most.
  MURO_INLINE MaskOf<S> covers(const TerrainGrid& grid, const V3<S>& p, double slack) const {
    const S a = side * (p.x - corner.x) * S(grid.per_spacing_x), b = side * (p.y - corner.y) * S(grid.per_spacing_y);
    return all_of(a >= S(-slack), b >= S(-slack), a + b <= S(1 + slack));
  }
  /// m: of the triangle.
  MURO_INLINE V3<S> inner_point(const TerrainGrid& grid) const {
    const S x = side * S(grid.spacing_x / 3), y = side * S(grid.spacing_y / 3);
    return {corner.x + x, corner.y + y, corner.z + (slope_x * x + slope_y * y)};
  }
  MURO_INLINE MaskOf<S> is(const Facet& other) const {
    return all_of(column == other.column, row == other.row, side == other.side);
  }
  /// Whether both share an edge. Then one is at -x -y of it.
  MURO_INLINE MaskOf<S> is_beside(const Facet& other) const {
    const S x = (other.column - column) * side, y = (other.row - row) * side;
    return all_of(side + other.side == S(0), x >= S(0), y >= S(0), x <= S(1), y <= S(1), x + y >= S(1));
  }
};

template <class S>
MURO_INLINE Facet<S> select(MaskOf<S> m, const Facet<S>& a, const Facet<S>& b) {
  return {select(m, a.column, b.column), select(m, a.row, b.row),         select(m, a.side, b.side),
          select(m, a.corner, b.corner), select(m, a.slope_x, b.slope_x), select(m, a.slope_y, b.slope_y),
          select(m, a.normal, b.normal)};
}

/// The triangle over or under a point; where that is beyond the rim, one near it.
template <class S>
MURO_INLINE Facet<S> facet_at(const TerrainGrid& grid, S x, S y) {
  S u = (x + S(grid.half_x)) * S(grid.per_spacing_x), v = (y + S(grid.half_y)) * S(grid.per_spacing_y);
  u = select(u > S(0), u, S(0)), v = select(v > S(0), v, S(0));  // of what is not a number too
  u = min(u, S(grid.columns - 1)), v = min(v, S(grid.rows - 1));
  constexpr int count = count_of<S>;
  double at_u[count], at_v[count], columns[count], rows[count], sides[count], corners[count], besides[count],
      aboves[count];
  lane::store_side_by_side(at_u, u), lane::store_side_by_side(at_v, v);
  const int most_column = grid.columns - 2, most_row = grid.rows - 2;
  for (int i = 0; i < count; ++i) {
    const int column = int(at_u[i]) < most_column ? int(at_u[i]) : most_column;
    const int row = int(at_v[i]) < most_row ? int(at_v[i]) : most_row;
    const bool upper = (at_u[i] - column) + (at_v[i] - row) > 1;
    const float* const lower_row = grid.values + std::ptrdiff_t(row) * grid.columns + column;
    const float* const upper_row = lower_row + grid.columns;
    const double right = lower_row[1], left = upper_row[0];
    columns[i] = column + upper;
    rows[i] = row + upper;
    sides[i] = upper ? -1 : 1;
    corners[i] = upper ? upper_row[1] : lower_row[0];
    besides[i] = upper ? left : right;
    aboves[i] = upper ? right : left;
  }
  // of the corner and of those along x and y from it
  const S corner = lane::load_side_by_side<S>(corners), beside = lane::load_side_by_side<S>(besides),
          above = lane::load_side_by_side<S>(aboves);
  Facet<S> f;
  f.column = lane::load_side_by_side<S>(columns), f.row = lane::load_side_by_side<S>(rows);
  f.side = lane::load_side_by_side<S>(sides);
  f.corner = {f.column * S(grid.spacing_x) - S(grid.half_x), f.row * S(grid.spacing_y) - S(grid.half_y),
              S(grid.scale) * corner};
  f.slope_x = (beside - corner) * (f.side * S(grid.scale * grid.per_spacing_x));
  f.slope_y = (above - corner) * (f.side * S(grid.scale * grid.per_spacing_y));
  const S up = S(1) / sqrt(S(1) + (f.slope_x * f.slope_x + f.slope_y * f.slope_y));
  f.normal = {-f.slope_x * up, -f.slope_y * up, up};
  return f;
}

/// The slopes near a shape, as far as a tile tells.
template <class S>
struct NearSlopes {
  S depth;       ///< m: of the centre below the tile's plane, along its normal
  V3<S> normal;  ///< unit, of the tile's plane
  S spread;
};

/// `centre`: of a shape that reaches no farther than the level.
template <class S>
MURO_INLINE NearSlopes<S> slopes_near(const TerrainGrid& grid, const TerrainLevel& level, const V3<S>& centre) {
  S u = (centre.x + S(grid.half_x)) * S(level.per_x), v = (centre.y + S(grid.half_y)) * S(level.per_y);
  u = select(u > S(0), u, S(0)), v = select(v > S(0), v, S(0));
  u = min(u, S(level.columns - 1)), v = min(v, S(level.rows - 1));
  constexpr int count = count_of<S>;
  double at_u[count], at_v[count], columns[count], rows[count], heights[count], slopes_x[count], slopes_y[count],
      spreads[count];
  lane::store_side_by_side(at_u, u), lane::store_side_by_side(at_v, v);
  for (int i = 0; i < count; ++i) {
    const int column = int(at_u[i]), row = int(at_v[i]);
    const TerrainTile& tile = level.tiles[std::ptrdiff_t(row) * level.columns + column];
    columns[i] = column, rows[i] = row;
    heights[i] = tile.height, slopes_x[i] = tile.slope_x, slopes_y[i] = tile.slope_y, spreads[i] = tile.spread;
  }
  const S column = lane::load_side_by_side<S>(columns), row = lane::load_side_by_side<S>(rows),
          height = lane::load_side_by_side<S>(heights), slope_x = lane::load_side_by_side<S>(slopes_x),
          slope_y = lane::load_side_by_side<S>(slopes_y);
  NearSlopes<S> near;
  near.spread = lane::load_side_by_side<S>(spreads);
  const S x = centre.x + S(grid.half_x) - (column + S(0.5)) * S(level.length_x),
          y = centre.y + S(grid.half_y) - (row + S(0.5)) * S(level.length_y);
  const S up = S(1) / sqrt(S(1) + (slope_x * slope_x + slope_y * slope_y));
  near.normal = {-slope_x * up, -slope_y * up, up};
  near.depth = (height + (slope_x * x + slope_y * y) - centre.z) * up;
  return near;
}

}  // namespace MURO_ISA
}  // namespace muro::native::lanes
