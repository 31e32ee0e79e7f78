// SPDX-License-Identifier: MIT
// First points at which a ray meets a solid shape.
//
// The ray starts at o (m) and has the unit direction d, both in the frame of the shape. Every function returns the
// distance (m) along the ray to the first point of the solid: 0 if the ray starts in it, infinity if the ray misses it.
// Solids are closed: a ray that lies in a face or touches a side hits.
//
// All primitives are convex, so a ray is inside during one interval [in, out]. The functions find it by intersecting
// simpler intervals (Kay and Kajiya: Ray tracing complex scenes, SIGGRAPH 1986). S is double or a lane of doubles.
#pragma once

#include "muro/simd/geometry.hpp"

namespace muro::raycast::rays {
inline namespace MURO_ISA {

using lane::V3;

inline constexpr double never = __builtin_inf();

/// The part of a ray inside a convex solid: distances along the ray; empty if out < in.
template <class S>
struct Interval {
  S in, out;

  /// Intersects with another interval. A NaN in `b` is ignored.
  MURO_INLINE void intersect(const Interval& b) {
    in = lane::max(b.in, in);
    out = lane::min(b.out, out);
  }
  /// Returns the distance to the first point at or after the start of the ray.
  MURO_INLINE S entry() const {
    const S start = lane::max(in, S(0));
    return lane::select(start <= out, start, S(never));
  }
};

/// Interval between two parallel planes at -half and +half; `inverse` is 1 / d. A ray parallel to the planes is always
/// or never inside. If it lies in one of them, the product 0 * infinity is a NaN, which Interval::intersect ignores.
template <class S>
MURO_INLINE Interval<S> slab(S o, S inverse, double half) {
  const S near_side = lane::select(inverse < S(0), S(-half), S(half));
  return {(-near_side - o) * inverse, (near_side - o) * inverse};
}

/// Interval inside the endless cylinder of the given radius about z. With c = (o x d)_z the ray passes the axis at the
/// distance |c| / sqrt(a): the discriminant in this form does not cancel for a far start (Haines, Gunther and
/// Akenine-Moeller: Precision improvements for ray/sphere intersection, Ray Tracing Gems, 2019).
template <class S>
MURO_INLINE Interval<S> tube(const V3<S>& o, const V3<S>& d, double radius) {
  const S a = d.x * d.x + d.y * d.y, c = o.x * d.y - o.y * d.x;
  const S middle = -(o.x * d.x + o.y * d.y) / a;
  const S discriminant = a * S(radius * radius) - c * c;
  const S half = lane::sqrt(lane::max(discriminant, S(0))) / a;
  const S in = lane::select(discriminant >= S(0), middle - half, S(never));
  const S out = middle + half;
  // parallel to the axis: always or never inside
  const S always = lane::select(o.x * o.x + o.y * o.y <= S(radius * radius), S(-never), S(never));
  return {lane::select(a > S(0), in, always), lane::select(a > S(0), out, -always)};
}

template <class S>
MURO_INLINE S enter_ball(const V3<S>& o, const V3<S>& d, double radius) {
  const S middle = -dot(o, d);  // middle of the chord, nearest to the centre
  const V3<S> p = o + middle * d;
  const S discriminant = S(radius * radius) - dot(p, p);
  const S half = lane::sqrt(lane::max(discriminant, S(0)));
  const Interval<S> chord{lane::select(discriminant >= S(0), middle - half, S(never)), middle + half};
  return chord.entry();
}

/// Distance to a box with half lengths hx, hy, hz; `inverse` is 1 / d.
template <class S>
MURO_INLINE S enter_box(const V3<S>& o, const V3<S>& inverse, double hx, double hy, double hz) {
  Interval<S> inside{S(-never), S(never)};
  inside.intersect(slab(o.x, inverse.x, hx));
  inside.intersect(slab(o.y, inverse.y, hy));
  inside.intersect(slab(o.z, inverse.z, hz));
  return inside.entry();
}

/// Distance to a cylinder about z, with flat ends at -half_length and +half_length.
template <class S>
MURO_INLINE S enter_cylinder(const V3<S>& o, const V3<S>& d, double radius, double half_length) {
  Interval<S> inside = tube(o, d, radius);
  inside.intersect(slab(o.z, S(1) / d.z, half_length));
  return inside.entry();
}

/// Distance to a capsule about z: a cylinder between -half_length and +half_length, with half balls at its ends.
template <class S>
MURO_INLINE S enter_capsule(const V3<S>& o, const V3<S>& d, double radius, double half_length) {
  const S straight = enter_cylinder(o, d, radius, half_length);
  const S top = enter_ball({o.x, o.y, o.z - S(half_length)}, d, radius);
  const S bottom = enter_ball({o.x, o.y, o.z + S(half_length)}, d, radius);
  return lane::min(straight, lane::min(top, bottom));
}

/// Distance to the half space z <= 0.
template <class S>
MURO_INLINE S enter_half_space(S oz, S dz) {
  const S distance = lane::select(dz < S(0), -oz / dz, S(never));
  return lane::select(oz <= S(0), S(0), distance);
}

}  // namespace MURO_ISA
}  // namespace muro::raycast::rays
