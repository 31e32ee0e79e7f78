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

/// Rounded down, of numbers from 0 to 2^31.
template <class S>
MURO_INLINE S floor_of(S x) {
  constexpr double shift = 0x1p52;
  const S rounded = (x + S(shift)) - S(shift);
  return rounded - select(rounded > x, S(1), S(0));
}

/// `from[at]` of each lane; `at`: whole numbers.
template <class S>
MURO_INLINE S gathered(const float* from, const S& at) {
  double values[count_of<S>];
  lane::store_side_by_side(values, at);
  for (double& v : values) v = from[std::ptrdiff_t(v)];
  return lane::load_side_by_side<S>(values);
}

/// Of a cell the triangle at +x +y (`upper`) or that at -x -y.
template <class S>
MURO_INLINE Facet<S> facet_of(const TerrainGrid& grid, S cell_column, S cell_row, MaskOf<S> upper) {
  Facet<S> f;
  f.side = select(upper, S(-1), S(1));
  const S is_upper = select(upper, S(1), S(0));
  f.column = cell_column + is_upper, f.row = cell_row + is_upper;
  // the corner and those along x and y from it
  const S node = f.row * S(grid.columns) + f.column;
  const S corner = gathered<S>(grid.values, node), beside = gathered<S>(grid.values, node + f.side),
          above = gathered<S>(grid.values, node + f.side * S(grid.columns));
  f.corner = {f.column * S(grid.spacing_x) - S(grid.half_x), f.row * S(grid.spacing_y) - S(grid.half_y),
              S(grid.scale) * corner};
  f.slope_x = (beside - corner) * (f.side * S(grid.scale * grid.per_spacing_x));
  f.slope_y = (above - corner) * (f.side * S(grid.scale * grid.per_spacing_y));
  const S up = S(1) / sqrt(S(1) + (f.slope_x * f.slope_x + f.slope_y * f.slope_y));
  f.normal = {-f.slope_x * up, -f.slope_y * up, up};
  return f;
}

/// A number from 0 to `most`; 0 of what is not a number.
template <class S>
MURO_INLINE S clamped(S x, double most) {
  return min(select(x > S(0), x, S(0)), S(most));
}

/// The triangle over or under a point; where that is beyond the rim, one near it.
template <class S>
MURO_INLINE Facet<S> facet_at(const TerrainGrid& grid, S x, S y) {
  const S u = clamped<S>((x + S(grid.half_x)) * S(grid.per_spacing_x), grid.columns - 1),
          v = clamped<S>((y + S(grid.half_y)) * S(grid.per_spacing_y), grid.rows - 1);
  const S column = min(floor_of(u), S(grid.columns - 2)), row = min(floor_of(v), S(grid.rows - 2));
  return facet_of<S>(grid, column, row, (u - column) + (v - row) > S(1));
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
  const S u = clamped<S>((centre.x + S(grid.half_x)) * S(level.per_x), level.columns - 1),
          v = clamped<S>((centre.y + S(grid.half_y)) * S(level.per_y), level.rows - 1);
  const S column = floor_of(u), row = floor_of(v);
  static_assert(sizeof(TerrainTile) == 4 * sizeof(float));
  const float* const numbers = &level.tiles->height;
  const S at = S(4) * (row * S(level.columns) + column);
  const S height = gathered<S>(numbers, at), slope_x = gathered<S>(numbers + 1, at),
          slope_y = gathered<S>(numbers + 2, at);
  NearSlopes<S> near;
  near.spread = gathered<S>(numbers + 3, at);
  const S x = centre.x + S(grid.half_x) - (column + S(0.5)) * S(level.length_x),
          y = centre.y + S(grid.half_y) - (row + S(0.5)) * S(level.length_y);
  const S up = S(1) / sqrt(S(1) + (slope_x * slope_x + slope_y * slope_y));
  near.normal = {-slope_x * up, -slope_y * up, up};
  near.depth = (height + (slope_x * x + slope_y * y) - centre.z) * up;
  return near;
}

}  // namespace MURO_ISA
}  // namespace muro::native::lanes
