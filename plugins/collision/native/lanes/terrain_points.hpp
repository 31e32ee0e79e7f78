// SPDX-License-Identifier: MIT
// The points of balls and wheels on gentle slopes of a heightmap.
#pragma once

#include "terrain_clearance.hpp"
#include "terrain_facets.hpp"
#include "terrain_way.hpp"

namespace muro::native::lanes {
inline namespace MURO_ISA {

/// Where slopes differ by no more than this, normals differ by less than 18 degrees: then all that touches a round
/// shape at one place is one contact, the deepest.
inline constexpr double gentle_spread = 0.16;
/// Where they differ by no more than this, all edges count as flat.
inline constexpr double even_spread = 5e-5;

/// Gives `sink(mask, point, normal, depth, number)` the points in which a shape and the ground below a heightmap
/// overlap, each half way between the surfaces, in the world, where they can be told in a few operations: those of
/// spheres and of lying cylinders on gentle slopes, over triangles and over the convex edge of two; and none for shapes
/// that are above the ground. Of a cylinder these are the lowest point of either rim, and where edges between them rise
/// against its side. `Shape` is ShapeInWorld<S>, or what has its functions.
template <class S, class Shape>
class TerrainPoints {
 public:
  TerrainPoints(const Shape& at, const TerrainGrid& grid) : at_(at), grid_(grid), half_(at.half()) {}

  /// Says whose points it cannot tell; of those nothing is given, or not all.
  template <class Sink>
  MURO_INLINE MaskOf<S> give(Sink& sink) const {
    const S radius(radius_of_all());
    const V3<S> centre = to_map(at_.centre() - lane::splat<S>(grid_.origin));
    const auto is_beside = any_of(abs(centre.x) > S(grid_.half_x) + radius, abs(centre.y) > S(grid_.half_y) + radius);
    const auto nobody = S(0) > S(0);
    const TerrainLevel* const level = grid_.level_for(radius_of_all());
    if (!level) return !is_beside;
    const NearSlopes<S> near = slopes_near(grid_, *level, centre);
    const auto may_touch = all_of(!is_beside, !(near.depth + reach_along(near.normal) <= S(0)));
    if (!any(may_touch)) return nobody;
    const auto is_gentle = near.spread <= S(gentle_spread);
    const bool is_round = at_.kind() == KernelShapeKind::sphere || at_.kind() == KernelShapeKind::cylinder;
    if (is_round && !any(all_of(may_touch, is_gentle))) return may_touch;
    switch (at_.kind()) {
      case KernelShapeKind::sphere: {
        const Touch touch = find_touch(centre, near.normal, V3<S>{S(0), S(0), S(0)}, S(half_[0]));
        const auto known = all_of(may_touch, touch.is_known, is_gentle);
        give_touch(known, touch, 0, sink);
        return all_of(may_touch, !known);
      }
      case KernelShapeKind::cylinder:
        return all_of(may_touch, give_rims(may_touch, centre, near, sink));
      default:
        return without_clear(may_touch, centre);
    }
  }

 private:
  /// The lowest point of a ball or rim.
  struct Touch {
    V3<S> point, normal;  ///< half way; in the frame of the heightmap
    S depth;
    Facet<S> first, second;  ///< the same, or those of the edge that it touches
    MaskOf<S> is_known;
  };
  /// Of the side of a wheel with an edge; known where it is between the rims.
  struct SideTouch : Touch {
    MaskOf<S> is_off;  ///< it would be known if the edge were longer: the wheel is over an end of it
  };
  /// Where two planes meet, seen from a point, in space or in the plane of a rim.
  struct Fold {
    V3<S> way;           ///< m, from the nearest point of the line to the point
    S length2;           ///< m^2, of that
    MaskOf<S> is_ahead;  ///< it leads between both normals, and the planes are not one
  };

  MURO_INLINE double radius_of_all() const {
    switch (at_.kind()) {
      case KernelShapeKind::sphere:
        return half_[0];
      case KernelShapeKind::capsule:
        return half_[0] + half_[2];
      default:
        return __builtin_sqrt(half_[0] * half_[0] + half_[1] * half_[1] + half_[2] * half_[2]);
    }
  }
  MURO_INLINE V3<S> to_map(const V3<S>& v) const {
    if (!grid_.is_turned) return v;
    const double* const a = grid_.axes;
    return {dot(lane::splat<S>(a), v), dot(lane::splat<S>(a + 3), v), dot(lane::splat<S>(a + 6), v)};
  }
  MURO_INLINE V3<S> to_world(const V3<S>& v) const {
    if (!grid_.is_turned) return v;
    const double* const a = grid_.axes;
    return v.x * lane::splat<S>(a) + v.y * lane::splat<S>(a + 3) + v.z * lane::splat<S>(a + 6);
  }
  MURO_INLINE V3<S> axis(int k) const { return to_map(at_.axis(k)); }

  /// How far (m) the shape reaches from its centre along a unit vector, and against it.
  MURO_INLINE S reach_along(const V3<S>& n) const {
    if (at_.kind() == KernelShapeKind::sphere) return S(half_[0]);
    const S along = dot(axis(2), n), end = S(half_[2]) * abs(along);
    if (at_.kind() == KernelShapeKind::capsule) return end + S(half_[0]);
    if (at_.kind() == KernelShapeKind::cylinder) return end + S(half_[0]) * sqrt(max(S(1) - along * along, S(0)));
    return S(half_[0]) * abs(dot(axis(0), n)) + S(half_[1]) * abs(dot(axis(1), n)) + end;
  }

  /// Leaves out those that a closer look shows to be above the ground. Of a box, mesh or capsule.
  MURO_INLINE MaskOf<S> without_clear(MaskOf<S> may_touch, const V3<S>& centre) const {
    const V3<S> axes[3] = {axis(0), axis(1), axis(2)};
    const double end = at_.kind() == KernelShapeKind::capsule ? half_[0] : 0;
    S left(0);
    for (int i = 0; i < count_of<S>; ++i) {
      if (!(bits(may_touch) >> i & 1)) continue;
      BoxOverTerrain box{{value_of(centre.x, i), value_of(centre.y, i), value_of(centre.z, i)},
                         {},
                         {half_[0], half_[1], half_[2] + end}};
      for (int k = 0; k < 3; ++k) {
        box.axes[k][0] = value_of(axes[k].x, i);
        box.axes[k][1] = value_of(axes[k].y, i);
        box.axes[k][2] = value_of(axes[k].z, i);
      }
      set_value(left, i, is_clear(grid_, box) ? 0 : 1);
    }
    return left > S(0);
  }

  template <class Sink>
  MURO_INLINE void give_touch(MaskOf<S> which, const Touch& touch, int number, Sink& sink) const {
    const auto below = all_of(which, touch.depth > S(0));
    if (!any(below)) return;
    sink(below, to_world(touch.point) + lane::splat<S>(grid_.origin), to_world(touch.normal), touch.depth, number);
  }

  /// From a point (`across`: 0) or in the plane across that unit vector.
  MURO_INLINE Fold fold_of(const Facet<S>& f, const Facet<S>& g, const V3<S>& from, const V3<S>& across) const {
    const V3<S> a = f.normal - dot(f.normal, across) * across, b = g.normal - dot(g.normal, across) * across;
    const S high_a = -f.depth_of(from), high_b = -g.depth_of(from), aa = dot(a, a), ab = dot(a, b), bb = dot(b, b),
            area = aa * bb - ab * ab;
    const S part_a = (high_a * bb - high_b * ab) / area, part_b = (high_b * aa - high_a * ab) / area;
    return {part_a * a + part_b * b, part_a * high_a + part_b * high_b,
            all_of(area > S(1e-12), part_a >= S(0), part_b >= S(0))};
  }

  /// Of a ball about `centre`, or of a rim about it with the axis `across`. `guess`: a normal of the ground near it.
  MURO_INLINE Touch find_touch(const V3<S>& centre, const V3<S>& guess, const V3<S>& across, S radius) const {
    constexpr double rounding = 1e-9;
    /// Of a plane: the lowest point along its normal, and the point of the plane nearest to the centre.
    struct Low {
      V3<S> point, foot;
    };
    const auto low = [&](const Facet<S>& f) {
      const V3<S> up = f.normal - dot(f.normal, across) * across;
      const S steep2 = dot(up, up);
      return Low{centre - up * (radius / sqrt(steep2)), centre + up * (f.depth_of(centre) / steep2)};
    };
    const V3<S> up = guess - dot(guess, across) * across;
    const V3<S> start = centre - up * (radius / sqrt(dot(up, up)));
    Touch touch;
    touch.first = touch.second = facet_at(grid_, start.x, start.y);
    const Low first = low(touch.first);
    V3<S> point = first.point;
    touch.normal = touch.first.normal;
    touch.depth = touch.first.depth_of(point);
    touch.is_known = touch.first.covers(grid_, first.foot, rounding);
    if (any(!touch.is_known)) {
      const Facet<S> next = facet_at(grid_, first.foot.x, first.foot.y);
      const Low second = low(next);
      const auto on_next = all_of(!touch.is_known, next.covers(grid_, second.foot, rounding));
      const Fold fold = fold_of(touch.first, next, centre, across);
      const S distance = sqrt(max(fold.length2, S(1e-300)));
      const V3<S> way = fold.way * (S(1) / distance), corner = centre - fold.way;
      const auto on_fold = all_of(!touch.is_known, !on_next, fold.is_ahead, touch.first.covers(grid_, corner, rounding),
                                  next.covers(grid_, corner, rounding));
      V3<S> normal = cross(cross(touch.first.normal, next.normal), cross(across, way));  // of a rim
      S size2 = dot(normal, normal);
      const auto of_ball = !(size2 > S(0));
      normal =
          select(of_ball, way, normal * (select(normal.z < S(0), S(-1), S(1)) / sqrt(select(of_ball, S(1), size2))));
      point = select(on_next, second.point, select(on_fold, centre - radius * way, point));
      touch.normal = select(on_next, next.normal, select(on_fold, normal, touch.normal));
      touch.depth = select(on_next, next.depth_of(second.point),
                           select(on_fold, (radius - distance) * dot(normal, way), touch.depth));
      touch.first = select(on_next, next, touch.first);
      touch.second = select(any_of(on_next, on_fold), next, touch.second);
      touch.is_known = any_of(touch.is_known, on_next, on_fold);
    }
    touch.is_known = all_of(touch.is_known, touch.first.depth_of(centre) < S(0));
    touch.point = point + (S(0.5) * touch.depth) * touch.normal;
    return touch;
  }

  /// Returns whose points are not known.
  template <class Sink>
  MURO_INLINE MaskOf<S> give_rims(MaskOf<S> which, const V3<S>& centre, const NearSlopes<S>& near, Sink& sink) const {
    const V3<S> u = axis(2), end = S(half_[2]) * u;
    const S radius(half_[0]);
    const Touch a = find_touch(centre + end, near.normal, u, radius),
                b = find_touch(centre - end, near.normal, u, radius);
    const auto lies = abs(dot(u, near.normal)) < S(0.5);
    const auto known = all_of(lies, a.is_known, b.is_known, near.spread <= S(gentle_spread));
    give_touch(all_of(which, known), a, 0, sink);
    give_touch(all_of(which, known), b, 1, sink);
    const auto on_one = any_of(a.first.is(b.first), a.first.is(b.second), a.second.is(b.first), a.second.is(b.second));
    const auto on_way = all_of(which, known, !on_one, !(near.spread <= S(even_spread)));
    if (!any(on_way)) return !known;
    const auto beside = all_of(on_way, a.first.is_beside(b.first));
    const SideTouch side = side_touch(a.first, b.first, centre, u, radius);
    give_touch(all_of(beside, side.is_known), side, 2, sink);
    const auto lost = any_of(!known, all_of(beside, side.is_off)), farther = all_of(on_way, !beside);
    if (!any(farther)) return lost;
    return any_of(lost, give_edges(farther, a, b, centre, u, radius, sink));
  }

  /// The edges that the line between the points of both rims crosses. Returns whose are not known.
  template <class Sink>
  MURO_INLINE MaskOf<S> give_edges(MaskOf<S> on_way, const Touch& a, const Touch& b, const V3<S>& centre,
                                   const V3<S>& u, S radius, Sink& sink) const {
    FacetWay<S> way(grid_, a.first, a.point, b.first, b.point);
    auto lost = S(0) > S(0);
    for (int edge = 0; edge < max_edges && any(on_way); ++edge) {
      const auto is_step = way.step(grid_);
      lost = any_of(lost, all_of(on_way, !is_step));
      on_way = all_of(on_way, is_step);
      const SideTouch side = side_touch(way.before, way.now, centre, u, radius);
      give_touch(all_of(on_way, side.is_known), side, 2 + edge, sink);
      lost = any_of(lost, all_of(on_way, side.is_off));
      on_way = all_of(on_way, !way.now.is(b.first));
    }
    return any_of(lost, on_way);
  }

  /// Of the side with the edge of two triangles.
  MURO_INLINE SideTouch side_touch(const Facet<S>& f, const Facet<S>& g, const V3<S>& centre, const V3<S>& u,
                                   S radius) const {
    const V3<S> edge = cross(f.normal, g.normal);
    const S cosine = dot(f.normal, g.normal);
    V3<S> n = cross(u, edge);
    const S size2 = dot(n, n);
    n = n * (select(n.z < S(0), S(-1), S(1)) / sqrt(max(size2, S(1e-300))));
    // a point of the line of both planes, by its parts along their normals
    const S high_f = -f.depth_of(centre), high_g = -g.depth_of(centre), sine2 = S(1) - cosine * cosine;
    const V3<S> from_line =
        ((high_f - cosine * high_g) / sine2) * f.normal + ((high_g - cosine * high_f) / sine2) * g.normal;
    const S along_f = dot(n, f.normal), along_g = dot(n, g.normal);
    const V3<S> beside = cross(n, edge);
    const S at = -dot(from_line, beside) / dot(u, beside);
    const S height = dot(n, from_line);
    const V3<S> axis_point = centre + at * u, nearest = axis_point - height * n;
    SideTouch touch;
    touch.first = f, touch.second = g;
    touch.normal = n;
    touch.depth = radius - height;
    touch.point = axis_point - (radius - S(0.5) * touch.depth) * n;
    const auto is_between = all_of(sine2 > S(1e-12), size2 > S(1e-12) * sine2, abs(at) < S(half_[2]),
                                   f.depth_of(g.inner_point(grid_)) > S(0), along_f - cosine * along_g >= S(0),
                                   along_g - cosine * along_f >= S(0));
    const auto is_on = all_of(f.covers(grid_, nearest, 1e-3), g.covers(grid_, nearest, 1e-3));
    touch.is_known = all_of(is_between, is_on);
    touch.is_off = all_of(is_between, !is_on, touch.depth > S(0));
    return touch;
  }

  static constexpr int max_edges = 6;  ///< of the eight points of a slot two are those of the rims
  const Shape& at_;
  const TerrainGrid& grid_;
  const double* const half_;
};

template <class S, class Shape, class Sink>
MURO_INLINE MaskOf<S> give_terrain_points(const Shape& at, const TerrainGrid& grid, Sink& sink) {
  return TerrainPoints<S, Shape>(at, grid).give(sink);
}

}  // namespace MURO_ISA
}  // namespace muro::native::lanes
