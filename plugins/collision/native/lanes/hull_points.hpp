// SPDX-License-Identifier: MIT
#pragma once

#include "plane_points.hpp"

namespace muro::native::lanes {
inline namespace MURO_ISA {

/// Calls `sink(mask, point, depth, number)` for the vertices of a hull that lie below a plane, by rising number, as
/// PlanePoints does. `body`: frame of the body of the hull.
template <class S, bool level, class Sink>
MURO_INLINE void give_hull_points(const KernelShape& shape, const BodyFrame<S>& body, const Plane<S, level>& plane,
                                  Sink& sink) {
  const ShapeInWorld<S> box(shape, body);
  S reach = plane.depth_of(box.centre());
  for (int k = 0; k < 3; ++k) reach += abs(S(shape.half[k]) * plane.along_normal(box.axis(k)));
  if (!any(reach > S(0))) return;
  const V3<S> x = body.axis(0), y = body.axis(1), z = body.axis(2);
  const S rise[3] = {plane.along_normal(x), plane.along_normal(y), plane.along_normal(z)},
          deep = plane.depth_of(body.position());
  const double* v = shape.vertices;
  for (int i = 0; i < shape.vertex_count; ++i, v += 3) {
    const S depth = deep - (S(v[0]) * rise[0] + S(v[1]) * rise[1] + S(v[2]) * rise[2]);
    const auto below = depth > S(0);
    if (!any(below)) continue;
    const V3<S> point = body.position() + (S(v[0]) * x + S(v[1]) * y + S(v[2]) * z);
    sink(below, plane.add_normal(point, S(0.5) * depth), depth, i);
  }
}

template <class S, class Sink>
MURO_INLINE void give_hull_points(const KernelShape& shape, const BodyFrame<S>& body, const GroundPlane& plane,
                                  Sink& sink) {
  if (plane.is_level)
    give_hull_points<S>(shape, body, Plane<S, true>(plane), sink);
  else
    give_hull_points<S>(shape, body, Plane<S, false>(plane), sink);
}

}  // namespace MURO_ISA
}  // namespace muro::native::lanes
