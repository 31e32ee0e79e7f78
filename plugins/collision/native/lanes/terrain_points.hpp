// SPDX-License-Identifier: MIT
// Points of balls and wheels on gentle slopes of a heightmap.
#pragma once

#include "shape_clearance.hpp"
#include "terrain_touch.hpp"
#include "terrain_way.hpp"

namespace muro::native::lanes {
inline namespace MURO_ISA {

/// Largest difference of slopes that counts as gentle. Normals then differ by less than 18 degrees, so that all that
/// touches a round shape at one place makes one contact, the deepest.
inline constexpr double gentle_spread = 0.16;
/// Largest difference of slopes at which all edges count as flat.
inline constexpr double even_spread = 5e-5;

/// Calls `sink(mask, point, normal, depth, number)` for the points in which a shape and the ground below a heightmap
/// overlap, in the world, each half way between the surfaces. It finds what needs few operations: points of spheres and
/// of lying cylinders on gentle slopes, over triangles and over the convex edge of two. Of a cylinder these are the
/// lowest point of each rim, and points where edges between them rise against its side. Shapes above the ground have no
/// points. `Shape` is ShapeInWorld<S>, or has its functions.
template <class S, class Shape>
class TerrainPoints {
 public:
  TerrainPoints(const Shape& at, const TerrainGrid& grid) : at_(at), grid_(grid), half_(at.half()) {}

  /// Returns the lanes whose points it cannot find. For these it gives no points, or not all.
  template <class Sink>
  MURO_INLINE MaskOf<S> give(Sink& sink) const {
    const bool is_ball = at_.kind() == KernelShapeKind::sphere;
    if (!is_ball && at_.kind() != KernelShapeKind::cylinder)
      return !(ShapeClearance<S, Shape>(at_, grid_).find(S(0) == S(0)) >= S(0));
    const double radius = radius_of_all(at_.kind(), half_);
    const V3<S> centre = to_map(grid_, at_.centre() - lane::splat<S>(grid_.origin));
    const auto is_beside = beyond_rim(grid_, centre, radius) > S(0);
    const TerrainLevel* const level = grid_.level_for(radius);
    if (!level) return !is_beside;
    const NearSlopes<S> near = slopes_near(grid_, *level, centre);
    const auto is_near = [&](S reach) { return all_of(!is_beside, !(near.rise + reach <= S(0))); };
    return is_ball ? give_ball(is_near, centre, near, sink) : give_wheel(is_near, centre, near, sink);
  }

 private:
  /// Contact of the side of a wheel with an edge. It is known if it is between the rims.
  struct SideTouch : Touch<S> {
    MaskOf<S> is_off;  ///< it would be known if the edge were longer: the wheel is over an end of the edge
  };

  template <class Sink>
  MURO_INLINE void give_touch(MaskOf<S> which, const Touch<S>& touch, int number, Sink& sink) const {
    const auto below = all_of(which, touch.depth > S(0));
    if (!any(below)) return;
    sink(below, to_world(grid_, touch.point) + lane::splat<S>(grid_.origin), to_world(grid_, touch.normal), touch.depth,
         number);
  }

  /// Gives the point of a ball. Returns the lanes whose points are not known.
  template <class IsNear, class Sink>
  MURO_INLINE MaskOf<S> give_ball(const IsNear& is_near, const V3<S>& centre, const NearSlopes<S>& near,
                                  Sink& sink) const {
    const S radius(half_[0]), length = sqrt(near.slopes.up2());
    const auto may_touch = is_near(radius * length);
    const auto is_gentle = all_of(may_touch, near.spread <= S(gentle_spread));
    if (!any(is_gentle)) return may_touch;
    const S per = radius / length;
    const Touch<S> touch = find_touch(grid_, Round<S, true>{centre, {}, radius}, centre.x + per * near.slopes.x,
                                      centre.y + per * near.slopes.y);
    const auto known = all_of(is_gentle, touch.is_known);
    give_touch(known, touch, 0, sink);
    return all_of(may_touch, !known);
  }

  /// Gives the points of a cylinder. Returns the lanes whose points are not known.
  template <class IsNear, class Sink>
  MURO_INLINE MaskOf<S> give_wheel(const IsNear& is_near, const V3<S>& centre, const NearSlopes<S>& near,
                                   Sink& sink) const {
    const V3<S> u = to_map(grid_, at_.axis(2)), end = S(half_[2]) * u;
    const S radius(half_[0]), along = near.slopes.along(u), up2 = near.slopes.up2(), along2 = along * along;
    const S steep = sqrt(max(up2 - along2, S(0)));
    const auto may_touch = is_near(S(half_[2]) * abs(along) + radius * steep);
    // the cylinder lies on its side
    const auto is_gentle = all_of(may_touch, along2 < S(0.25) * up2, near.spread <= S(gentle_spread));
    if (!any(is_gentle)) return may_touch;
    // from the centres of the rims to their lowest points
    const S per = radius / steep;
    const S down_x = per * (near.slopes.x + along * u.x), down_y = per * (near.slopes.y + along * u.y);
    const V3<S> end_a = centre + end, end_b = centre - end;
    const Touch<S> a = find_touch(grid_, Round<S, false>{end_a, u, radius}, end_a.x + down_x, end_a.y + down_y);
    const Touch<S> b = find_touch(grid_, Round<S, false>{end_b, u, radius}, end_b.x + down_x, end_b.y + down_y);
    const auto known = all_of(is_gentle, a.is_known, b.is_known), lost = all_of(may_touch, !known);
    give_touch(known, a, 0, sink);
    give_touch(known, b, 1, sink);
    const auto is_one = any_of(a.number == b.number, a.number == b.other, b.number == a.other, a.other == b.other);
    const auto on_way = all_of(known, !(near.spread <= S(even_spread)), !is_one);
    if (!any(on_way)) return lost;
    return any_of(lost, give_sides(on_way, a, b, centre, u, radius, sink));
  }

  /// Gives the points where edges between both rims touch the side. Returns the lanes whose points are not known.
  template <class Sink>
  MURO_INLINE MaskOf<S> give_sides(MaskOf<S> on_way, const Touch<S>& a, const Touch<S>& b, const V3<S>& centre,
                                   const V3<S>& u, S radius, Sink& sink) const {
    const auto beside = all_of(on_way, a.facet.is_beside(b.facet)), farther = all_of(on_way, !beside);
    auto lost = S(0) > S(0);
    if (any(all_of(beside, is_convex(a.facet, b.facet)))) {
      const SideTouch side = side_touch(a.facet, b.facet, centre, u, radius);
      give_touch(all_of(beside, side.is_known), side, 2, sink);
      lost = all_of(beside, side.is_off);
    }
    return any(farther) ? any_of(lost, give_edges(farther, a, b, centre, u, radius, sink)) : lost;
  }

  /// Gives the points on edges that the line between the points of both rims crosses. Returns the lanes whose points
  /// are not known.
  template <class Sink>
  MURO_INLINE MaskOf<S> give_edges(MaskOf<S> on_way, const Touch<S>& a, const Touch<S>& b, const V3<S>& centre,
                                   const V3<S>& u, S radius, Sink& sink) const {
    FacetWay<S> way(grid_, a.facet, a.point, b.facet, b.point);
    auto lost = S(0) > S(0);
    for (int edge = 0; edge < max_edges && any(on_way); ++edge) {
      const auto is_step = way.step(grid_);
      lost = any_of(lost, all_of(on_way, !is_step));
      on_way = all_of(on_way, is_step);
      if (any(all_of(on_way, is_convex(way.before, way.now)))) {
        const SideTouch side = side_touch(way.before, way.now, centre, u, radius);
        give_touch(all_of(on_way, side.is_known), side, 2 + edge, sink);
        lost = any_of(lost, all_of(on_way, side.is_off));
      }
      on_way = all_of(on_way, !way.now.is(b.facet));
    }
    return any_of(lost, on_way);
  }

  /// Whether the edge between two triangles is convex.
  MURO_INLINE MaskOf<S> is_convex(const Facet<S>& f, const Facet<S>& g) const {
    return f.rise_over(g.inner_point(grid_)) > S(0);
  }

  /// Returns the contact of the side with the edge of two triangles.
  MURO_INLINE SideTouch side_touch(const Facet<S>& f, const Facet<S>& g, const V3<S>& centre, const V3<S>& u,
                                   S radius) const {
    const V3<S> normal_f = f.normal(), normal_g = g.normal();
    const V3<S> edge = cross(normal_f, normal_g);
    const S cosine = dot(normal_f, normal_g);
    V3<S> n = cross(u, edge);
    const S size2 = dot(n, n);
    n = n * (select(n.z < S(0), S(-1), S(1)) / sqrt(max(size2, S(1e-300))));
    // from the line in which both planes meet to the centre, by its parts along their normals
    const S high_f = -f.rise_over(centre) * normal_f.z, high_g = -g.rise_over(centre) * normal_g.z,
            sine2 = S(1) - cosine * cosine;
    const V3<S> from_line =
        ((high_f - cosine * high_g) / sine2) * normal_f + ((high_g - cosine * high_f) / sine2) * normal_g;
    const S along_f = dot(n, normal_f), along_g = dot(n, normal_g);
    const V3<S> beside = cross(n, edge);
    const S at = -dot(from_line, beside) / dot(u, beside);
    const S height = dot(n, from_line);
    const V3<S> axis_point = centre + at * u, nearest = axis_point - height * n;
    SideTouch touch;
    touch.normal = n;
    touch.depth = radius - height;
    touch.point = axis_point - (radius - S(0.5) * touch.depth) * n;
    const auto is_between = all_of(sine2 > S(1e-12), size2 > S(1e-12) * sine2, abs(at) < S(half_[2]), is_convex(f, g),
                                   along_f - cosine * along_g >= S(0), along_g - cosine * along_f >= S(0));
    const auto is_on = all_of(f.covers(grid_, nearest.x, nearest.y, 1e-3), g.covers(grid_, nearest.x, nearest.y, 1e-3));
    touch.is_known = all_of(is_between, is_on);
    touch.is_off = all_of(is_between, !is_on, touch.depth > S(0));
    return touch;
  }

  static constexpr int max_edges = 6;  ///< a slot has eight points, two are those of the rims
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
