// SPDX-License-Identifier: MIT
// Primitives relative to the scanner.
#pragma once

#include "intersect.hpp"
#include "range_culling.hpp"

namespace muro::raycast::rays {
inline namespace MURO_ISA {

MURO_INLINE V3<double> vector_at(const double* n) { return {n[0], n[1], n[2]}; }
/// The axes of a frame: rows of a matrix.
struct Axes {
  V3<double> x, y, z;
  /// Returns the vector in the frame.
  MURO_INLINE V3<double> operator*(const V3<double>& v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
};
MURO_INLINE Axes axes_at(const double* n) { return {vector_at(n), vector_at(n + 3), vector_at(n + 6)}; }

MURO_INLINE void put(double* to, const V3<double>& v) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }

/// Sets the box around the primitive relative to the scanner, clipped and enlarged as in BlockFromScanner.
MURO_INLINE void bound(const Primitive& s, const Axes& axes, const V3<double>& centre, double max_range,
                       PlacedPrimitive& p) {
  const auto half_extent = [&s](double x, double y, double z) {
    return lane::abs(x) * s.half[0] + lane::abs(y) * s.half[1] + lane::abs(z) * s.half[2];
  };
  const double c[3] = {centre.x, centre.y, centre.z};
  const bool sphere = s.kind == PrimitiveKind::sphere;
  const double h[3] = {sphere ? s.sx : half_extent(axes.x.x, axes.y.x, axes.z.x),
                       sphere ? s.sx : half_extent(axes.x.y, axes.y.y, axes.z.y),
                       sphere ? s.sx : half_extent(axes.x.z, axes.y.z, axes.z.z)};
  double low[3], high[3], extent = 0;
  for (int k = 0; k < 3; ++k) {
    low[k] = lane::max(c[k] - h[k], -max_range);
    high[k] = lane::min(c[k] + h[k], max_range);
    extent = lane::max(extent, lane::max(-low[k], high[k]));
  }
  const double margin = extent * slack + min_slack;
  for (int k = 0; k < 3; ++k) p.low[k] = float(low[k] - margin), p.high[k] = float(high[k] + margin);
}

/// Places a primitive of a robot at the present pose of its body.
inline void place_on_robot(const Primitive& s, const ScanQuery& query, PlacedPrimitive& p) {
  const double* b = s.body;
  const lane::M3<double> body = lane::Q4<double>{b[3], b[4], b[5], b[6]}.matrix();
  const Axes in_body = axes_at(s.axes);
  const Axes axes{body * in_body.x, body * in_body.y, body * in_body.z};
  const V3<double> centre =
      body * vector_at(s.position) + vector_at(b) - vector_at(query.position);  // from the scanner
  p.kind = s.kind;
  p.id = s.id;
  p.sx = s.sx, p.sy = s.sy, p.sz = s.sz;
  put(p.origin, -(axes * centre));
  put(p.axes, axes.x), put(p.axes + 3, axes.y), put(p.axes + 6, axes.z);
  bound(s, axes, centre, query.max_range, p);
}

/// Places a primitive of the scenery, without its box.
MURO_INLINE void place_in_scenery(const Primitive& s, const ScanQuery& query, PlacedPrimitive& p) {
  p.kind = s.kind;
  p.id = s.id;
  p.sx = s.sx, p.sy = s.sy, p.sz = s.sz;
  const Axes axes = axes_at(s.axes);
  put(p.origin, axes * (vector_at(query.position) - vector_at(s.position)));
  __builtin_memcpy(p.axes, s.axes, sizeof p.axes);
}

}  // namespace MURO_ISA
}  // namespace muro::raycast::rays
