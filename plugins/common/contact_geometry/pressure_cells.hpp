// SPDX-License-Identifier: MIT
// Points where friction acts in lines and faces that touch. Collision gives the ends of a line and the corners of a
// face. Normal forces act there, so that a body tips over its true edge. But friction is spread over the whole area:
// each point represents a cell of the area, and friction of a cell acts in its middle. On average, the middles of the
// cells are as far from the middle of all points as the pressure over the area.
#pragma once

#include <type_traits>

#include "muro/simd/geometry.hpp"

namespace muro::contact_geometry {

/// Cosine of 8 degrees: normals of one patch differ by less.
inline constexpr double same_direction = 0.99;
/// Speed limit (m/s) of the ends of a cell about its middle. A slower spin does not release a body that rests.
inline constexpr double least_spin = 5e-6;

inline namespace MURO_ISA {

using lane::max, lane::min, lane::select, lane::sqrt, lane::V3;

/// Returns the shift (m) from the first end of a line to the middle of its cell; for the second end it is the opposite.
template <class S>
MURO_INLINE V3<S> shift_in_line(const V3<S>& first, const V3<S>& second) {
  return (second - first) * S(0.25);
}

/// Points of a face: their number, the sums of their coordinates and of products of these.
template <class S>
struct FacePoints {
  S count{0};
  V3<S> sum{S(0), S(0), S(0)};
  S xx{0}, yy{0}, zz{0}, yz{0}, zx{0}, xy{0};

  MURO_INLINE void add(const V3<S>& p) {
    count += S(1);
    sum += p;
    xx += p.x * p.x, yy += p.y * p.y, zz += p.z * p.z;
    yz += p.y * p.z, zx += p.z * p.x, xy += p.x * p.y;
  }
  template <class M>
  MURO_INLINE void add_where(M mask, const FacePoints& b) {
    const S zero(0);
    count += select(mask, b.count, zero);
    sum += select(mask, b.sum, {zero, zero, zero});
    xx += select(mask, b.xx, zero), yy += select(mask, b.yy, zero), zz += select(mask, b.zz, zero);
    yz += select(mask, b.yz, zero), zx += select(mask, b.zx, zero), xy += select(mask, b.xy, zero);
  }
  MURO_INLINE V3<S> middle() const { return sum * (S(1) / count); }
  /// Returns 1 if they spread equally in all directions of their plane, as the corners of a square; 0 on a line.
  MURO_INLINE S roundness() const {
    const S part = S(1) / count;
    const V3<S> m = sum * part;
    const S a = xx * part - m.x * m.x, b = yy * part - m.y * m.y, c = zz * part - m.z * m.z;
    const S d = yz * part - m.y * m.z, e = zx * part - m.z * m.x, f = xy * part - m.x * m.y;
    const S trace = a + b + c, squares = a * a + b * b + c * c + S(2) * (d * d + e * e + f * f);
    const S all = trace * trace;
    return max(min(S(2) * (all - squares) / max(all, S(1e-300)), S(1)), S(0));
  }
};

/// Returns the distance of the middles of a face's cells from its middle, as a part of the distance of its points. It
/// is the mean distance of an area divided by that of its corners: 1/2 for a line, 0.541 for a square, 2/3 for a disc.
/// `distances` (m): sum over the points, from their middle; `farthest` (m): the largest; `is_disc`: points are on a
/// rim.
template <class S>
MURO_INLINE S share_of_cells(const FacePoints<S>& points, S distances, S farthest, S is_disc) {
  const S corners = select(is_disc > S(0), S(0), S(2) / (points.count * points.count));
  const S share = S(0.5) + points.roundness() * (S(1.0 / 6) - corners);
  return min(share * farthest * points.count / max(distances, S(1e-300)), S(1));
}

/// Calls `sink(i, shift)` for `count` points of one patch, with the shift from `point(i)` to the middle of its cell.
/// `is_disc`: 1 if the points are on a rim, else 0.
template <class S = double, class Point, class Sink>
MURO_INLINE void find_shifts(int count, std::type_identity_t<S> is_disc, const Point& point, const Sink& sink) {
  if (count == 2) {
    const V3<S> shift = shift_in_line(point(0), point(1));
    sink(0, shift);
    sink(1, -shift);
  }
  if (count <= 2) return;
  const V3<S> origin = point(0);
  FacePoints<S> face;
  for (int i = 0; i < count; ++i) face.add(point(i) - origin);
  const V3<S> middle = origin + face.middle();
  S distances(0), farthest(0);
  for (int i = 0; i < count; ++i) {
    const V3<S> d = point(i) - middle;
    const S distance = sqrt(dot(d, d));
    distances += distance, farthest = max(farthest, distance);
  }
  const S rest = S(1) - share_of_cells(face, distances, farthest, is_disc);
  for (int i = 0; i < count; ++i) sink(i, (middle - point(i)) * rest);
}

}  // namespace MURO_ISA
}  // namespace muro::contact_geometry
