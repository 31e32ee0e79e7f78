// SPDX-License-Identifier: MIT
// Where a ray first meets a solid shape.
//
// The ray starts at o (m) and has the unit direction d, both in the frame of the shape. Every function returns the
// distance (m) along the ray to the first point of the solid: 0 when the ray starts in it, infinity when the ray
// misses it. Solids are closed: a ray that lies in a face or touches a side hits.
//
// All solids are convex, so a ray is inside during one interval [in, out]; the functions find it by intersecting
// simpler intervals (Kay and Kajiya: Ray tracing complex scenes, SIGGRAPH 1986). There are no branches, so that loops
// over rays vectorise; `Real` is double, or any type with the same operators and the overloads of namespace `lane`.
#pragma once

#include <cmath>
#include <limits>

namespace muro::raycast {

// What the kernels need beside arithmetic and comparison. A comparison with a NaN is false, so a NaN as the second
// argument of lesser and greater is left out.
namespace lane {
inline double select(bool yes, double a, double b) { return yes ? a : b; }
inline double lesser(double a, double b) { return b < a ? b : a; }
inline double greater(double a, double b) { return b > a ? b : a; }
inline double root(double x) { return std::sqrt(x); }
inline double with_sign(double magnitude, double sign) { return std::copysign(magnitude, sign); }
}  // namespace lane

inline constexpr double never = std::numeric_limits<double>::infinity();

/// Where a ray is inside a convex solid: distances along it; empty when out < in.
template <class Real>
struct Interval {
  Real in, out;

  void intersect(const Interval& b) {
    in = lane::greater(in, b.in);
    out = lane::lesser(out, b.out);
  }
  /// The distance to the first point at or after the start of the ray.
  Real entry() const {
    const Real start = lane::greater(in, Real(0.0));
    return lane::select(start <= out, start, Real(never));
  }
};

/// Between two parallel planes at -half and +half. A ray along the planes is inside always or never; where it lies
/// in one of them the product 0 * infinity is a NaN, which intersect leaves out.
template <class Real>
Interval<Real> slab(Real o, Real d, double half) {
  const Real inverse = Real(1.0) / d, near_side = lane::with_sign(Real(half), d);
  return {(-near_side - o) * inverse, (near_side - o) * inverse};
}

/// Inside the endless cylinder of the given radius about z. With c = (o x d)_z the ray passes the axis at the
/// distance |c| / sqrt(a): the discriminant in this form does not cancel for a far start (Haines, Gunther and
/// Akenine-Moeller: Precision improvements for ray/sphere intersection, Ray Tracing Gems, 2019).
template <class Real>
Interval<Real> tube(Real ox, Real oy, Real dx, Real dy, double radius) {
  const Real a = dx * dx + dy * dy, c = ox * dy - oy * dx;
  const Real middle = -(ox * dx + oy * dy) / a;
  const Real discriminant = a * (radius * radius) - c * c;
  const Real half = lane::root(lane::greater(Real(0.0), discriminant)) / a;
  const Real in = lane::select(discriminant >= Real(0.0), middle - half, Real(never));
  const Real out = middle + half;
  // parallel to the axis: inside always or never
  const Real always = lane::select(ox * ox + oy * oy <= Real(radius * radius), Real(-never), Real(never));
  return {lane::select(a > Real(0.0), in, always), lane::select(a > Real(0.0), out, -always)};
}

template <class Real>
Real enter_ball(Real ox, Real oy, Real oz, Real dx, Real dy, Real dz, double radius) {
  const Real middle = -(ox * dx + oy * dy + oz * dz);  // of the chord, nearest to the centre
  const Real px = ox + middle * dx, py = oy + middle * dy, pz = oz + middle * dz;
  const Real discriminant = Real(radius * radius) - (px * px + py * py + pz * pz);
  const Real half = lane::root(lane::greater(Real(0.0), discriminant));
  const Interval<Real> chord{lane::select(discriminant >= Real(0.0), middle - half, Real(never)), middle + half};
  return chord.entry();
}

/// Half lengths hx, hy, hz.
template <class Real>
Real enter_box(Real ox, Real oy, Real oz, Real dx, Real dy, Real dz, double hx, double hy, double hz) {
  Interval<Real> inside{Real(-never), Real(never)};
  inside.intersect(slab(ox, dx, hx));
  inside.intersect(slab(oy, dy, hy));
  inside.intersect(slab(oz, dz, hz));
  return inside.entry();
}

/// About z, with flat ends at -half_length and +half_length.
template <class Real>
Real enter_cylinder(Real ox, Real oy, Real oz, Real dx, Real dy, Real dz, double radius, double half_length) {
  Interval<Real> inside = tube(ox, oy, dx, dy, radius);
  inside.intersect(slab(oz, dz, half_length));
  return inside.entry();
}

/// About z: a cylinder between -half_length and +half_length, with half balls at its ends.
template <class Real>
Real enter_capsule(Real ox, Real oy, Real oz, Real dx, Real dy, Real dz, double radius, double half_length) {
  const Real straight = enter_cylinder(ox, oy, oz, dx, dy, dz, radius, half_length);
  const Real top = enter_ball(ox, oy, oz - Real(half_length), dx, dy, dz, radius);
  const Real bottom = enter_ball(ox, oy, oz + Real(half_length), dx, dy, dz, radius);
  return lane::lesser(straight, lane::lesser(top, bottom));
}

/// The half space z <= 0.
template <class Real>
Real enter_half_space(Real oz, Real dz) {
  const Real distance = lane::select(dz < Real(0.0), -oz / dz, Real(never));
  return lane::select(oz <= Real(0.0), Real(0.0), distance);
}

}  // namespace muro::raycast
