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

/// Gives `sink(mask, point, depth, number)` the points of a solid that may lie below a plane, each point half way
/// between the two surfaces: sphere: its lowest point. box: its corners. capsule: of either end the lowest point.
/// cylinder: of the rim of either end the lowest point, the highest, and the two between: so one on its side rests on
/// the ends of its lowest line, one that stands upright on four points of its rim, with all steps between. `number` is
/// the same for the same point, below 8. The mask says who is below; a call where nobody is may be left out.
template <class S>
class PlanePoints {
 public:
  PlanePoints(const Standing<S>& at, const Plane<S>& plane)
      : at_(at), plane_(plane), half_(at.solid().half), centre_(at.centre()), deep_(plane.depth_of(centre_)) {}

  template <class Sink>
  MURO_INLINE void give(Sink& sink) const {
    switch (at_.solid().form) {
      case Form::box:
        return corners(sink);
      case Form::sphere:
        return lowest(centre_ - S(half_[0]) * plane_.normal, deep_ + S(half_[0]), 0, sink);
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
  /// `point` of the solid is `depth` below.
  template <class Sink>
  MURO_INLINE void lowest(const V3<S>& point, S depth, int number, Sink& sink) const {
    const auto below = depth > S(0);
    if (any(below)) sink(below, point + (S(0.5) * depth) * plane_.normal, depth, number);
  }

  template <class Sink>
  MURO_INLINE void corners(Sink& sink) const {
    const M3<S> axes{at_.axis(0), at_.axis(1), at_.axis(2)};
    const S hx(half_[0]), hy(half_[1]), hz(half_[2]);
    const S rx = dot(axes.x, plane_.normal) * hx, ry = dot(axes.y, plane_.normal) * hy,
            rz = dot(axes.z, plane_.normal) * hz;  // how far each face is above the centre
    if (!any(deep_ + (abs(rx) + abs(ry) + abs(rz)) > S(0))) return;
    for (int corner = 0; corner < 8; ++corner) {
      const S sx(corner & 1 ? 1 : -1), sy(corner & 2 ? 1 : -1), sz(corner & 4 ? 1 : -1);
      lowest(centre_ + axes * V3<S>{sx * hx, sy * hy, sz * hz}, deep_ - (sx * rx + sy * ry + sz * rz), corner, sink);
    }
  }

  template <class Sink>
  MURO_INLINE void rims(Sink& sink) const {
    const V3<S> n = plane_.normal, u = at_.axis(2);
    const S slope = dot(n, u), r(half_[0]), half(half_[2]), rise = half * slope;
    V3<S> down = slope * u - n;  // towards the lowest point of a rim
    const S steep = sqrt(dot(down, down)), low = r * steep, middle = deep_ + abs(rise);
    if (!any(middle + low > S(0))) return;
    const auto upright = steep <= S(1e-9);
    const V3<S> end = half * u;
    down = down * (r / steep);
    const auto more = upright | (middle > S(0));
    // Upright any four points serve; those on the axes of the cylinder turn with it.
    if (any(more)) down = select(upright, r * at_.axis(0), down);
    const V3<S> lowest_middle = centre_ + down;
    lowest(lowest_middle + end, deep_ - rise + low, 0, sink);
    lowest(lowest_middle - end, deep_ + rise + low, 1, sink);
    if (any(more)) {
      const V3<S> across = cross(u, down);
      for (int k = 0; k < 2; ++k) {
        const V3<S> cap = k == 0 ? centre_ + end : centre_ - end;
        const S depth = k == 0 ? deep_ - rise : deep_ + rise;
        lowest(cap + across, depth, 2 + 3 * k, sink);
        lowest(cap - across, depth, 3 + 3 * k, sink);
        lowest(cap - down, depth - low, 4 + 3 * k, sink);
      }
    }
  }

  template <class Sink>
  MURO_INLINE void ends(Sink& sink) const {
    const V3<S> end = S(half_[2]) * at_.axis(2);
    for (int k = 0; k < 2; ++k) {
      const V3<S> centre = k == 0 ? centre_ + end : centre_ - end;
      lowest(centre - S(half_[0]) * plane_.normal, plane_.depth_of(centre) + S(half_[0]), k, sink);
    }
  }

  const Standing<S>& at_;
  const Plane<S>& plane_;
  const double* half_;
  const V3<S> centre_;
  const S deep_;  ///< of the centre
};

}  // namespace MURO_ISA
}  // namespace muro::native::lanes
