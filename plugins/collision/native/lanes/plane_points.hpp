// SPDX-License-Identifier: MIT
// The points of solids that lie below a plane.
#pragma once

#include "lanes/solid.hpp"

namespace muro::native::lanes {
inline namespace MURO_ISA {

/// The solid side is below, against the normal (unit).
template <class S>
struct Plane {
  V3<S> normal, origin;

  /// How deep `point` lies below (m).
  MURO_INLINE S depth_of(const V3<S>& point) const { return dot(normal, origin - point); }
};

/// Gives `sink(mask, point, depth, number)` the points of a solid at `at` that may lie below the plane, each point
/// half way between the two surfaces: sphere: its lowest point. box: its corners. capsule: of either end the lowest
/// point. cylinder: of the rim of either end the lowest point, the highest, and the two between: so one on its side
/// rests on the ends of its lowest line, one that stands upright on four points of its rim, with all steps between.
/// `number` is the same for the same point, below 8. A call tells nothing when nobody is below.
template <class S>
class PlanePoints {
 public:
  using V = V3<S>;

  PlanePoints(const Solid& solid, const Turned<S>& at, const Plane<S>& plane)
      : solid_(solid), at_(at), plane_(plane), deep_(plane.depth_of(at.position)) {}

  template <class Sink>
  MURO_INLINE void give(Sink& sink) const {
    switch (solid_.form) {
      case Form::box:
        return corners(sink);
      case Form::sphere:
        return lowest(at_.position - radius() * plane_.normal, deep_ + radius(), 0, sink);
      case Form::cylinder:
        return rims(sink);
      case Form::capsule:
        return ends(sink);
      case Form::plane:
      case Form::mesh:
        return;
    }
  }

 private:
  S radius() const { return S(solid_.half[0]); }

  /// `point` of the solid is `depth` below.
  template <class Sink>
  MURO_INLINE void lowest(const V& point, S depth, int number, Sink& sink) const {
    const auto below = depth > S(0);
    if (any(below)) sink(below, point + (S(0.5) * depth) * plane_.normal, depth, number);
  }

  template <class Sink>
  MURO_INLINE void corners(Sink& sink) const {
    const S hx(solid_.half[0]), hy(solid_.half[1]), hz(solid_.half[2]);
    const V rise = transposed_times(at_.axes, plane_.normal);  // of each axis along the normal
    const V r{rise.x * hx, rise.y * hy, rise.z * hz};
    if (!any(deep_ + (abs(r.x) + abs(r.y) + abs(r.z)) > S(0))) return;
    for (int corner = 0; corner < 8; ++corner) {
      const S sx(corner & 1 ? 1 : -1), sy(corner & 2 ? 1 : -1), sz(corner & 4 ? 1 : -1);
      lowest(at_.position + at_.axes * V{sx * hx, sy * hy, sz * hz}, deep_ - (sx * r.x + sy * r.y + sz * r.z), corner,
             sink);
    }
  }

  template <class Sink>
  MURO_INLINE void rims(Sink& sink) const {
    const V &n = plane_.normal, &u = at_.axes.z;
    const S slope = dot(n, u), r = radius(), half(solid_.half[2]), rise = half * slope;
    V down = slope * u - n;  // towards the lowest point of a rim
    const S steep = sqrt(dot(down, down)), low = r * steep;
    if (!any(deep_ + abs(rise) + low > S(0))) return;
    // Upright: any four points serve; those on the axes of the cylinder turn with it.
    down = select(steep > S(1e-9), down * (r / steep), r * at_.axes.x);
    const V end = half * u;
    for (int k = 0; k < 2; ++k) {
      const V cap = k == 0 ? at_.position + end : at_.position - end;
      const S depth = k == 0 ? deep_ - rise : deep_ + rise;
      lowest(cap + down, depth + low, 4 * k, sink);
      if (!any(depth > S(0))) continue;
      const V across = cross(u, down);
      lowest(cap + across, depth, 4 * k + 1, sink);
      lowest(cap - across, depth, 4 * k + 2, sink);
      lowest(cap - down, depth - low, 4 * k + 3, sink);
    }
  }

  template <class Sink>
  MURO_INLINE void ends(Sink& sink) const {
    const V end = S(solid_.half[2]) * at_.axes.z;
    for (int k = 0; k < 2; ++k) {
      const V centre = k == 0 ? at_.position + end : at_.position - end;
      lowest(centre - radius() * plane_.normal, plane_.depth_of(centre) + radius(), k, sink);
    }
  }

  const Solid& solid_;
  const Turned<S>& at_;
  const Plane<S>& plane_;
  const S deep_;  ///< of the centre
};

}  // namespace MURO_ISA
}  // namespace muro::native::lanes
