// SPDX-License-Identifier: MIT
// The path of the sixteen rays of a packet through the scene.
#pragma once

#include "intersect.hpp"
#include "primitive_placement.hpp"

namespace muro::raycast::rays {
inline namespace MURO_ISA {

/// The planes of a frustum, in the world.
struct FrustumPlanes {
  float x[4], y[4], z[4];

  MURO_INLINE void set(const Frustum& f, const ScanQuery& s) {
    float m[9];
    for (int k = 0; k < 9; ++k) m[k] = float(s.axes[k]);
    for (int k = 0; k < 4; ++k) {
      x[k] = m[0] * f.x[k] + m[1] * f.y[k] + m[2] * f.z[k];
      y[k] = m[3] * f.x[k] + m[4] * f.y[k] + m[5] * f.z[k];
      z[k] = m[6] * f.x[k] + m[7] * f.y[k] + m[8] * f.z[k];
    }
  }
  /// Returns bits: bit i is set if candidate i is not completely outside of one of the planes.
  MURO_INLINE unsigned overlapping(const Candidates& c) const {
    F min(0);
    for (int k = 0; k < 4; ++k) {  // the corner that is farthest along the normal
      const float* cx = (x[k] > 0 ? c.high : c.low)[0];
      const float* cy = (y[k] > 0 ? c.high : c.low)[1];
      const float* cz = (z[k] > 0 ? c.high : c.low)[2];
      min = lane::min(load<F>(cx) * F(x[k]) + load<F>(cy) * F(y[k]) + load<F>(cz) * F(z[k]), min);
    }
    return ~signs(min) & ((1u << c.count) - 1);
  }
};

/// Values of a packet that are computed before its rays meet anything. There are no branches, so that a processor can
/// work on several packets at once and does not wait for divisions.
struct PacketSetup {
  V3<D> direction[2];    ///< in the world
  V3<D> inverse[2];      ///< 1 / direction
  V3<F> rounded;         ///< direction as floats
  V3<F> finite_inverse;  ///< 1 / rounded, large instead of infinite
  FrustumPlanes planes;  ///< around the rays
  unsigned first;        ///< bits of the candidates of the first block that overlap the frustum

  MURO_INLINE void set(const RayPacket& b, const ScanQuery& s, const Candidates* candidates) {
    const double* m = s.axes;
    for (int h = 0; h < 2; ++h) {
      const D x = load<D>(b.x + 8 * h), y = load<D>(b.y + 8 * h), z = load<D>(b.z + 8 * h);
      V3<D>& d = direction[h];
      d = {D(m[0]) * x + D(m[1]) * y + D(m[2]) * z, D(m[3]) * x + D(m[4]) * y + D(m[5]) * z,
           D(m[6]) * x + D(m[7]) * y + D(m[8]) * z};
      inverse[h] = {D(1) / d.x, D(1) / d.y, D(1) / d.z};
    }
    rounded = {narrow(direction[0].x, direction[1].x), narrow(direction[0].y, direction[1].y),
               narrow(direction[0].z, direction[1].z)};
    const auto inverse_of = [](F a) { return F(1) / lane::select(lane::abs(a) < F(1e-20f), F(1e-20f), a); };
    finite_inverse = {inverse_of(rounded.x), inverse_of(rounded.y), inverse_of(rounded.z)};
    planes.set(b.frustum, s);
    first = candidates ? planes.overlapping(*candidates) : 0;
  }
};

MURO_INLINE V3<D> splat(const double* n) { return lane::splat<D>(n); }

/// Returns the distances at which half of the rays enter a primitive that is not an aligned box.
MURO_INLINE D enter(const PlacedPrimitive& p, const V3<D>& direction) {
  const V3<D> o = splat(p.origin);
  const V3<D> d{dot(splat(p.axes), direction), dot(splat(p.axes + 3), direction), dot(splat(p.axes + 6), direction)};
  switch (p.kind) {
    case PrimitiveKind::aligned_box:
    case PrimitiveKind::box:
      return enter_box(o, {D(1) / d.x, D(1) / d.y, D(1) / d.z}, p.sx, p.sy, p.sz);
    case PrimitiveKind::sphere:
      return enter_ball(o, d, p.sx);
    case PrimitiveKind::cylinder:
      return enter_cylinder(o, d, p.sx, p.sz);
    case PrimitiveKind::capsule:
    case PrimitiveKind::heightmap:
      break;
  }
  return enter_capsule(o, d, p.sx, p.sz);
}

/// The nearest hits of a packet so far. with_ids: whether the collider that was hit is recorded.
template <bool with_ids>
struct PacketTraversal {
  const PacketSetup* setup;
  D distance[2];  ///< to the nearest hits so far
  D id[2];        ///< number of the collider that was hit; -1: none
  F far;          ///< upper bound of distance

  PacketTraversal() = default;
  MURO_INLINE PacketTraversal(const PacketSetup& s, double max_range) : setup(&s) {
    for (int h = 0; h < 2; ++h) distance[h] = D(max_range), id[h] = D(-1);
    far = F(float(max_range) * (1 + slack));
  }
  /// Whether some ray may travel farther than `near` (m) without a hit.
  MURO_INLINE bool may_pass(float near) const { return signs(far - F(near)) != all_signs; }
  /// Whether some ray may enter the box before its nearest hit so far.
  MURO_INLINE bool may_enter(const V3<F>& low, const V3<F>& high) const {
    const V3<F>& inverse = setup->finite_inverse;
    const F x0 = low.x * inverse.x, x1 = high.x * inverse.x, y0 = low.y * inverse.y, y1 = high.y * inverse.y,
            z0 = low.z * inverse.z, z1 = high.z * inverse.z;
    const F in = lane::max(lane::max(lane::min(x0, x1), lane::min(y0, y1)), lane::min(z0, z1));
    const F out = lane::min(lane::min(lane::max(x0, x1), lane::max(y0, y1)), lane::max(z0, z1));
    return signs(lane::min(lane::min(out, far) - in, out)) != all_signs;
  }

  void intersect(const PlacedPrimitive& p) {
    for (int h = 0; h < 2; ++h) accept(h, enter(p, setup->direction[h]), p.id);
    update_far();
  }
  MURO_INLINE void intersect_aligned_box(const Primitive& s, const ScanQuery& query) {
    const V3<double> from = vector_at(query.position) - vector_at(s.position);
    const V3<D> o{D(from.x), D(from.y), D(from.z)};
    for (int h = 0; h < 2; ++h) accept(h, enter_box(o, setup->inverse[h], s.sx, s.sy, s.sz), s.id);
    update_far();
  }
  MURO_INLINE void intersect_plane(const PlaneCandidate& f) {
    const V3<F>& d = setup->rounded;
    const F down = d.x * F(-float(f.normal[0])) + d.y * F(-float(f.normal[1])) + d.z * F(-float(f.normal[2]));
    if (f.height > 0 && signs((down + F(slack)) * far - F(float(f.height) * (1 - slack))) == all_signs) return;
    for (int h = 0; h < 2; ++h)
      accept(h, enter_half_space(D(f.height), dot(splat(f.normal), setup->direction[h])), f.id);
    update_far();
  }
  /// Takes distances that were found for all rays; infinity for rays that hit nothing.
  MURO_INLINE void take(const double* found, std::uint32_t found_id) {
    for (int h = 0; h < 2; ++h) accept(h, load<D>(found + 8 * h), found_id);
    update_far();
  }

 private:
  /// Takes the hits that are nearer than the hits so far.
  MURO_INLINE void accept(int h, D found, double found_id) {
    if constexpr (with_ids) {
      const auto nearer = (found < distance[h]) | ((found == distance[h]) & (D(found_id) < id[h]));
      id[h] = lane::select(nearer, D(found_id), id[h]);
    }
    distance[h] = lane::min(found, distance[h]);
  }
  MURO_INLINE void update_far() { far = narrow(distance[0], distance[1]) * F(1 + slack); }
};

}  // namespace MURO_ISA
}  // namespace muro::raycast::rays
