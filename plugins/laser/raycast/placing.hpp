// SPDX-License-Identifier: MIT
// Solids of robots, placed where they stand.
#pragma once

#include "reach.hpp"

namespace muro::raycast::rays {
inline namespace MURO_ISA {

MURO_INLINE V3<double> vector_at(const double* n) { return {n[0], n[1], n[2]}; }
/// Rows of a matrix: the axes of a frame.
struct Axes {
  V3<double> x, y, z;
  /// A vector in the frame.
  MURO_INLINE V3<double> operator*(const V3<double>& v) const { return {dot(x, v), dot(y, v), dot(z, v)}; }
};
MURO_INLINE Axes axes_at(const double* n) { return {vector_at(n), vector_at(n + 3), vector_at(n + 6)}; }

MURO_INLINE void put(double* to, const V3<double>& v) { to[0] = v.x, to[1] = v.y, to[2] = v.z; }

/// The box around the solid, seen from the scanner: as Seen.
MURO_INLINE void bound(const Solid& s, const Axes& axes, const V3<double>& centre, double max_range, Placed& p) {
  const auto reach = [&s](double x, double y, double z) {
    return lane::abs(x) * s.half[0] + lane::abs(y) * s.half[1] + lane::abs(z) * s.half[2];
  };
  const double c[3] = {centre.x, centre.y, centre.z};
  const bool ball = s.kind == SolidKind::sphere;
  const double h[3] = {ball ? s.sx : reach(axes.x.x, axes.y.x, axes.z.x),
                       ball ? s.sx : reach(axes.x.y, axes.y.y, axes.z.y),
                       ball ? s.sx : reach(axes.x.z, axes.y.z, axes.z.z)};
  double low[3], high[3], extent = 0;
  for (int k = 0; k < 3; ++k) {
    low[k] = lane::max(c[k] - h[k], -max_range);
    high[k] = lane::min(c[k] + h[k], max_range);
    extent = lane::max(extent, lane::max(-low[k], high[k]));
  }
  const double wider = extent * slack + least_slack;
  for (int k = 0; k < 3; ++k) p.low[k] = float(low[k] - wider), p.high[k] = float(high[k] + wider);
}

/// Where the solid of a robot is now.
inline void place(const Solid& s, const Scanner& scanner, Placed& p) {
  const double* b = s.body;
  const lane::M3<double> body = lane::Q4<double>{b[3], b[4], b[5], b[6]}.matrix();
  const Axes in_body = axes_at(s.axes);
  const Axes axes{body * in_body.x, body * in_body.y, body * in_body.z};
  const V3<double> centre =
      body * vector_at(s.position) + vector_at(b) - vector_at(scanner.position);  // from the scanner
  p.kind = s.kind;
  p.id = s.id;
  p.sx = s.sx, p.sy = s.sy, p.sz = s.sz;
  put(p.origin, -(axes * centre));
  put(p.axes, axes.x), put(p.axes + 3, axes.y), put(p.axes + 6, axes.z);
  bound(s, axes, centre, scanner.max_range, p);
}

/// A solid of the scenery, seen from the scanner; without its box.
MURO_INLINE void see(const Solid& s, const Scanner& scanner, Placed& p) {
  p.kind = s.kind;
  p.id = s.id;
  p.sx = s.sx, p.sy = s.sy, p.sz = s.sz;
  const Axes axes = axes_at(s.axes);
  put(p.origin, axes * (vector_at(scanner.position) - vector_at(s.position)));
  __builtin_memcpy(p.axes, s.axes, sizeof p.axes);
}

}  // namespace MURO_ISA
}  // namespace muro::raycast::rays
