// SPDX-License-Identifier: MIT
// Points where balls and the rims of wheels touch a heightmap.
#pragma once

#include "terrain_facets.hpp"

namespace muro::native::lanes {
inline namespace MURO_ISA {

/// A ball, or the rim of a wheel with an axis, in the frame of a heightmap.
template <class S, bool is_ball>
struct Round {
  V3<S> centre;  ///< m
  V3<S> axis;    ///< unit; only of a rim
  S radius;      ///< m
};

/// Contact at the lowest point of a ball or rim.
template <class S>
struct Touch {
  V3<S> point, normal;  ///< half way between the surfaces; in the frame of the heightmap
  S depth;
  Facet<S> facet;  ///< the triangle that it touches
  S number;        ///< number of that triangle
  S other;         ///< the same, or the number of the other triangle at the edge that it touches
  MaskOf<S> is_known;
};

/// Lowest point of a ball or rim relative to the plane of a triangle.
template <class S>
struct LowestPoint {
  V3<S> point, normal;
  S depth;
  S rise;            ///< m, of the plane over the centre
  S foot_x, foot_y;  ///< m, point of the plane that is nearest to the centre

  template <bool is_ball>
  MURO_INLINE LowestPoint(const Facet<S>& f, const Round<S, is_ball>& round) {
    const V3<S>& c = round.centre;
    rise = f.rise_over(c);
    const S length = sqrt(f.slopes.up2());
    if constexpr (is_ball) {
      const S per_length = S(1) / length;
      normal = f.slopes.up() * per_length;
      depth = rise * per_length + round.radius;
      point = c - round.radius * normal;
      foot_x = c.x + normal.x * (rise * per_length), foot_y = c.y + normal.y * (rise * per_length);
    } else {
      // upward in the plane of the rim
      const S along = f.slopes.along(round.axis);
      const V3<S> up = f.slopes.up() - along * round.axis;
      const S steep = sqrt(f.slopes.up2() - along * along), per = S(1) / (steep * length);
      const S per_length = steep * per, per_steep = length * per;
      normal = f.slopes.up() * per_length;
      depth = (rise + round.radius * steep) * per_length;
      point = c - up * (round.radius * per_steep);
      const S to_foot = rise * (per_steep * per_steep);
      foot_x = c.x + up.x * to_foot, foot_y = c.y + up.y * to_foot;
    }
  }
};

/// Line where two planes meet, relative to the centre, in space or in the plane of a rim.
template <class S>
struct Fold {
  V3<S> way;           ///< m, from the nearest point of the line to the centre
  S length2;           ///< m^2, of `way`
  MaskOf<S> is_ahead;  ///< `way` points between both normals, and the planes differ
  V3<S> edge;          ///< along the edge

  template <bool is_ball>
  MURO_INLINE Fold(const Facet<S>& f, const Facet<S>& g, const Round<S, is_ball>& round) {
    const V3<S> n = f.normal(), m = g.normal();
    edge = cross(n, m);
    V3<S> a = n, b = m;
    if constexpr (!is_ball) a = n - dot(n, round.axis) * round.axis, b = m - dot(m, round.axis) * round.axis;
    const S high_a = -f.rise_over(round.centre) * n.z, high_b = -g.rise_over(round.centre) * m.z, aa = dot(a, a),
            ab = dot(a, b), bb = dot(b, b), area = aa * bb - ab * ab;
    const S part_a = (high_a * bb - high_b * ab) / area, part_b = (high_b * aa - high_a * ab) / area;
    way = part_a * a + part_b * b;
    length2 = part_a * high_a + part_b * high_b;
    is_ahead = all_of(area > S(1e-12), part_a >= S(0), part_b >= S(0));
  }
};

/// Slack at the sides of a triangle, as a part of their length.
inline constexpr double touch_slack = 1e-9;

/// Checks the triangle at the point of the first triangle's plane that is nearest to the centre, and the edge between
/// both, in lanes where `touch` is not known yet. `foot_x`, `foot_y` (m): that point.
template <class S, bool is_ball>
[[gnu::noinline]] void find_beside(const TerrainGrid& grid, const Round<S, is_ball>& round, S foot_x, S foot_y,
                                   Touch<S>& touch) {
  const Facet<S>& first = touch.facet;
  const auto unknown = !touch.is_known;
  const Facet<S> next = facet_at(grid, foot_x, foot_y);
  const LowestPoint<S> second(next, round);
  const auto on_next =
      all_of(unknown, second.rise < S(0), next.covers(grid, second.foot_x, second.foot_y, touch_slack));
  const Fold<S> fold(first, next, round);
  const S distance = sqrt(max(fold.length2, S(1e-300)));
  const V3<S> way = fold.way * (S(1) / distance), corner = round.centre - fold.way;
  const auto on_fold =
      all_of(unknown, !on_next, fold.is_ahead, first.rise_over(round.centre) < S(0),
             first.covers(grid, corner.x, corner.y, touch_slack), next.covers(grid, corner.x, corner.y, touch_slack));
  V3<S> normal = way;
  if constexpr (!is_ball) {
    normal = cross(fold.edge, cross(round.axis, way));
    const S size2 = dot(normal, normal);
    normal = normal * (select(normal.z < S(0), S(-1), S(1)) / sqrt(max(size2, S(1e-300))));
  }
  touch.point = select(on_next, second.point, select(on_fold, round.centre - round.radius * way, touch.point));
  touch.normal = select(on_next, second.normal, select(on_fold, normal, touch.normal));
  touch.depth =
      select(on_next, second.depth, select(on_fold, (round.radius - distance) * dot(normal, way), touch.depth));
  const S number = next.number(grid);
  touch.other = select(any_of(on_next, on_fold), number, touch.other);
  touch.number = select(on_next, number, touch.number);
  touch.is_known = any_of(touch.is_known, on_next, on_fold);
  touch.facet = select(on_next, next, touch.facet);
}

/// Finds the contact of a ball or rim. `x`, `y` (m): a point over a triangle that it may touch.
template <class S, bool is_ball>
MURO_INLINE Touch<S> find_touch(const TerrainGrid& grid, const Round<S, is_ball>& round, S x, S y) {
  Touch<S> touch;
  touch.facet = facet_at(grid, x, y);
  const LowestPoint<S> low(touch.facet, round);
  touch.point = low.point, touch.normal = low.normal, touch.depth = low.depth;
  touch.number = touch.other = touch.facet.number(grid);
  touch.is_known = all_of(low.rise < S(0), touch.facet.covers(grid, low.foot_x, low.foot_y, touch_slack));
  if (any(!touch.is_known)) find_beside(grid, round, low.foot_x, low.foot_y, touch);
  touch.point = touch.point + (S(0.5) * touch.depth) * touch.normal;
  return touch;
}

}  // namespace MURO_ISA
}  // namespace muro::native::lanes
