// SPDX-License-Identifier: MIT
// Points of shapes that lie below a plane.
#pragma once

#include "kernel_shape.hpp"

namespace muro::native::lanes {
inline namespace MURO_ISA {

/// A plane. Most planes are `level`: for these, products with 0 and with 1 are omitted, and nothing else.
template <class S, bool level>
class Plane {
 public:
  explicit Plane(const GroundPlane& g) : normal_(lane::splat<S>(g.normal)), origin_(lane::splat<S>(g.origin)) {}

  /// Returns `v` plus `s` times the normal.
  MURO_INLINE V3<S> add_normal(const V3<S>& v, S s) const {
    if constexpr (level) return {v.x, v.y, v.z + s};
    return v + s * normal_;
  }
  MURO_INLINE S along_normal(const V3<S>& v) const {
    if constexpr (level) return v.z;
    return dot(normal_, v);
  }
  /// Returns how deep (m) `point` lies below the plane.
  MURO_INLINE S depth_of(const V3<S>& point) const {
    if constexpr (level) return origin_.z - point.z;
    return dot(normal_, origin_ - point);
  }

 private:
  const V3<S> normal_, origin_;
};

/// Calls `sink(mask, point, depth, number)` for the points of a shape that may lie below a plane. Each point is half
/// way between the two surfaces. Sphere: its lowest point. Box: its corners. Capsule: the lowest point of each end.
/// Cylinder: of the rim of each end the lowest point, the highest, and the two between. So a cylinder on its side rests
/// on the ends of its lowest line, and an upright one on four points of its rim, with all steps between. `number` is
/// below 8, and the same for the same point. `mask`: the lanes that are below; a call with none may be omitted. `Shape`
/// is ShapeInWorld<S>, or has its functions.
template <class S, class Shape, bool level>
class PlanePoints {
 public:
  PlanePoints(const Shape& at, const Plane<S, level>& plane, double least_tilt)
      : at_(at),
        plane_(plane),
        half_(at.half()),
        centre_(at.centre()),
        deep_(plane.depth_of(centre_)),
        least_tilt_(least_tilt) {}

  template <class Sink>
  MURO_INLINE void give(Sink& sink) const {
    switch (at_.kind()) {
      case KernelShapeKind::box:
        return corners(sink);
      case KernelShapeKind::sphere:
        return lowest(plane_.add_normal(centre_, -S(half_[0])), deep_ + S(half_[0]), 0, sink);
      case KernelShapeKind::cylinder:
        return rims(sink);
      case KernelShapeKind::capsule:
        return ends(sink);
      case KernelShapeKind::plane:
      case KernelShapeKind::mesh:
      case KernelShapeKind::heightmap:
        return;
    }
  }

 private:
  /// Gives `point` of the shape, which is `depth` (m) below the plane.
  template <class Sink>
  MURO_INLINE void lowest(const V3<S>& point, S depth, int number, Sink& sink) const {
    const auto below = depth > S(0);
    if (any(below)) sink(below, plane_.add_normal(point, S(0.5) * depth), depth, number);
  }

  template <class Sink>
  MURO_INLINE void corners(Sink& sink) const {
    const S rx = S(half_[0]) * plane_.along_normal(at_.axis(0)), ry = S(half_[1]) * plane_.along_normal(at_.axis(1)),
            rz = S(half_[2]) * plane_.along_normal(at_.axis(2));
    if (!any(deep_ + (abs(rx) + abs(ry) + abs(rz)) > S(0))) return;
    const V3<S> x = S(half_[0]) * at_.axis(0), y = S(half_[1]) * at_.axis(1), z = S(half_[2]) * at_.axis(2);
    for (int corner = 0; corner < 8; ++corner) {
      const S sx(corner & 1 ? 1 : -1), sy(corner & 2 ? 1 : -1), sz(corner & 4 ? 1 : -1);
      lowest(centre_ + (sx * x + sy * y + sz * z), deep_ - (sx * rx + sy * ry + sz * rz), corner, sink);
    }
  }

  template <class Sink>
  MURO_INLINE void rims(Sink& sink) const {
    const V3<S> u = at_.axis(2);
    const S slope = plane_.along_normal(u), r(half_[0]), half(half_[2]), rise = half * slope;
    V3<S> down = plane_.add_normal(slope * u, S(-1));  // towards the lowest point of a rim
    const S steep = sqrt(dot(down, down)), low = r * steep, middle = deep_ + abs(rise);
    if (!any(middle + low > S(0))) return;
    const auto upright = steep <= S(least_tilt_);
    const auto more = upright | (middle > S(0));
    down = down * (r / steep);
    // Any four points suffice when upright; those on the axes of the cylinder turn with it.
    if (any(more)) down = select(upright, r * at_.axis(0), down);
    const V3<S> end = half * u, line = centre_ + down;
    lowest(line + end, deep_ - rise + low, 0, sink);
    lowest(line - end, deep_ + rise + low, 1, sink);
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
      lowest(plane_.add_normal(centre, -S(half_[0])), plane_.depth_of(centre) + S(half_[0]), k, sink);
    }
  }

  const Shape& at_;
  const Plane<S, level>& plane_;
  const double* const half_;
  const V3<S> centre_;
  const S deep_;  ///< of the centre
  const double least_tilt_;
};

/// Gives the points of PlanePoints. `least_tilt`: sine of the angle below which a cylinder counts as upright.
template <class S, class Shape, class Sink>
MURO_INLINE void give_plane_points(const Shape& at, const GroundPlane& plane, Sink& sink, double least_tilt = 1e-9) {
  if (plane.is_level)
    PlanePoints<S, Shape, true>(at, Plane<S, true>(plane), least_tilt).give(sink);
  else
    PlanePoints<S, Shape, false>(at, Plane<S, false>(plane), least_tilt).give(sink);
}

}  // namespace MURO_ISA
}  // namespace muro::native::lanes
