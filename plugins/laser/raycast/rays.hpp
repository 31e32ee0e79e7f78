// SPDX-License-Identifier: MIT
// The sixteen rays of a bundle.
#pragma once

#include "intersect.hpp"
#include "placing.hpp"

namespace muro::raycast::rays {
inline namespace MURO_ISA {

/// The planes of a frustum in the world.
struct Planes {
  float x[4], y[4], z[4];

  MURO_INLINE void set(const Frustum& f, const Scanner& s) {
    float m[9];
    for (int k = 0; k < 9; ++k) m[k] = float(s.axes[k]);
    for (int k = 0; k < 4; ++k) {
      x[k] = m[0] * f.x[k] + m[1] * f.y[k] + m[2] * f.z[k];
      y[k] = m[3] * f.x[k] + m[4] * f.y[k] + m[5] * f.z[k];
      z[k] = m[6] * f.x[k] + m[7] * f.y[k] + m[8] * f.z[k];
    }
  }
  /// Those that have no plane between them and the rays: bit by bit.
  MURO_INLINE unsigned let_in(const Candidates& c) const {
    F least(0);
    for (int k = 0; k < 4; ++k) {  // the corner that lies farthest along the normal
      const float* cx = (x[k] > 0 ? c.high : c.low)[0];
      const float* cy = (y[k] > 0 ? c.high : c.low)[1];
      const float* cz = (z[k] > 0 ? c.high : c.low)[2];
      least = lane::min(load<F>(cx) * F(x[k]) + load<F>(cy) * F(y[k]) + load<F>(cz) * F(z[k]), least);
    }
    return ~signs(least) & ((1u << c.count) - 1);
  }
};

/// What is known of a bundle before its rays meet anything. Free of branches, so that a processor may work at several
/// bundles at once and need not wait for divisions.
struct Ready {
  V3<D> d[2];        ///< directions in the world
  V3<D> inverse[2];  ///< 1 / d
  V3<F> rounded;     ///< d
  V3<F> about;       ///< 1 / d, finite
  Planes planes;     ///< around the rays
  unsigned first;    ///< of the first sixteen candidates those that the planes let in

  MURO_INLINE void set(const Bundle& b, const Scanner& s, const Candidates* candidates) {
    const double* m = s.axes;
    for (int h = 0; h < 2; ++h) {
      const D x = load<D>(b.x + 8 * h), y = load<D>(b.y + 8 * h), z = load<D>(b.z + 8 * h);
      d[h] = {D(m[0]) * x + D(m[1]) * y + D(m[2]) * z, D(m[3]) * x + D(m[4]) * y + D(m[5]) * z,
              D(m[6]) * x + D(m[7]) * y + D(m[8]) * z};
      inverse[h] = {D(1) / d[h].x, D(1) / d[h].y, D(1) / d[h].z};
    }
    rounded = {narrow(d[0].x, d[1].x), narrow(d[0].y, d[1].y), narrow(d[0].z, d[1].z)};
    const auto inverse_of = [](F a) { return F(1) / lane::select(lane::abs(a) < F(1e-20f), F(1e-20f), a); };
    about = {inverse_of(rounded.x), inverse_of(rounded.y), inverse_of(rounded.z)};
    planes.set(b.frustum, s);
    first = candidates ? planes.let_in(*candidates) : 0;
  }
};

MURO_INLINE V3<D> splat(const double* n) { return lane::splat<D>(n); }

/// Where half of the rays enter a solid that is not an upright box.
MURO_INLINE D enter(const Placed& p, const V3<D>& direction) {
  const V3<D> o = splat(p.origin);
  const V3<D> d{dot(splat(p.axes), direction), dot(splat(p.axes + 3), direction), dot(splat(p.axes + 6), direction)};
  switch (p.kind) {
    case SolidKind::upright_box:
    case SolidKind::box:
      return enter_box(o, {D(1) / d.x, D(1) / d.y, D(1) / d.z}, p.sx, p.sy, p.sz);
    case SolidKind::sphere:
      return enter_ball(o, d, p.sx);
    case SolidKind::cylinder:
      return enter_cylinder(o, d, p.sx, p.sz);
    case SolidKind::capsule:
      break;
  }
  return enter_capsule(o, d, p.sx, p.sz);
}

/// The rays on their way. with_ids: whether they remember what they hit.
template <bool with_ids>
struct Rays {
  const Ready& ready;
  D distance[2];  ///< to the nearest hit so far
  D id[2];        ///< of what it hits; -1: nothing
  F far;          ///< not less than distance

  MURO_INLINE Rays(const Ready& r, double max_range) : ready(r) {
    for (int h = 0; h < 2; ++h) distance[h] = D(max_range), id[h] = D(-1);
    far = F(float(max_range) * (1 + slack));
  }
  /// Whether any ray may go farther than that without a hit.
  MURO_INLINE bool pass(float away) const { return signs(far - F(away)) != all_signs; }
  /// Whether any ray may meet the box not farther than what it meets so far.
  MURO_INLINE bool enter_bounds(const V3<F>& low, const V3<F>& high) const {
    const V3<F>& about = ready.about;
    const F x0 = low.x * about.x, x1 = high.x * about.x, y0 = low.y * about.y, y1 = high.y * about.y,
            z0 = low.z * about.z, z1 = high.z * about.z;
    const F in = lane::max(lane::max(lane::min(x0, x1), lane::min(y0, y1)), lane::min(z0, z1));
    const F out = lane::min(lane::min(lane::max(x0, x1), lane::max(y0, y1)), lane::max(z0, z1));
    return signs(lane::min(lane::min(out, far) - in, out)) != all_signs;
  }

  void meet(const Placed& p) {
    for (int h = 0; h < 2; ++h) offer(h, enter(p, ready.d[h]), p.id);
    shorten();
  }
  MURO_INLINE void meet_upright(const Solid& s, const Scanner& scanner) {
    const V3<double> from = vector_at(scanner.position) - vector_at(s.position);
    const V3<D> o{D(from.x), D(from.y), D(from.z)};
    for (int h = 0; h < 2; ++h) offer(h, enter_box(o, ready.inverse[h], s.sx, s.sy, s.sz), s.id);
    shorten();
  }
  MURO_INLINE void meet_plane(const Fall& f) {
    const V3<F>& d = ready.rounded;
    const F down = d.x * F(-float(f.normal[0])) + d.y * F(-float(f.normal[1])) + d.z * F(-float(f.normal[2]));
    if (f.height > 0 && signs((down + F(slack)) * far - F(float(f.height) * (1 - slack))) == all_signs) return;
    for (int h = 0; h < 2; ++h) offer(h, enter_half_space(D(f.height), dot(splat(f.normal), ready.d[h])), f.id);
    shorten();
  }

 private:
  MURO_INLINE void offer(int h, D found, double whose) {
    if constexpr (with_ids) {
      const auto nearer = (found < distance[h]) | ((found == distance[h]) & (D(whose) < id[h]));
      id[h] = lane::select(nearer, D(whose), id[h]);
    }
    distance[h] = lane::min(found, distance[h]);
  }
  MURO_INLINE void shorten() { far = narrow(distance[0], distance[1]) * F(1 + slack); }
};

}  // namespace MURO_ISA
}  // namespace muro::raycast::rays
