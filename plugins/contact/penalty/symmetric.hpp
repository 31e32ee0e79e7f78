// SPDX-License-Identifier: MIT
// Symmetric matrices over a double or SIMD lanes of robots: inertias and sums of products.
#pragma once

#include "muro/simd/geometry.hpp"

namespace muro::penalty::law {
inline namespace MURO_ISA {

using lane::M3, lane::select, lane::sqrt, lane::V3;

template <class S>
struct Symmetric {
  S xx, yy, zz, xy, xz, yz;

  MURO_INLINE Symmetric& operator+=(const Symmetric& b) {
    xx += b.xx, yy += b.yy, zz += b.zz;
    xy += b.xy, xz += b.xz, yz += b.yz;
    return *this;
  }
  MURO_INLINE friend Symmetric operator+(Symmetric a, const Symmetric& b) { return a += b; }
  MURO_INLINE friend Symmetric operator*(S s, const Symmetric& m) {
    return {s * m.xx, s * m.yy, s * m.zz, s * m.xy, s * m.xz, s * m.yz};
  }
  MURO_INLINE friend V3<S> operator*(const Symmetric& m, const V3<S>& v) {
    return {m.xx * v.x + m.xy * v.y + m.xz * v.z, m.xy * v.x + m.yy * v.y + m.yz * v.z,
            m.xz * v.x + m.yz * v.y + m.zz * v.z};
  }
  /// Returns the matrix in the lanes of the mask, and 0 in the others.
  template <class M>
  MURO_INLINE Symmetric where(M mask) const {
    const S zero(0);
    return {select(mask, xx, zero), select(mask, yy, zero), select(mask, zz, zero),
            select(mask, xy, zero), select(mask, xz, zero), select(mask, yz, zero)};
  }
  MURO_INLINE S trace() const { return xx + yy + zz; }
  /// Frobenius norm.
  MURO_INLINE S norm() const { return sqrt((xx * xx + yy * yy + zz * zz) + S(2) * (xy * xy + xz * xz + yz * yz)); }
  MURO_INLINE V3<S> column_x() const { return {xx, xy, xz}; }
  MURO_INLINE V3<S> column_y() const { return {xy, yy, yz}; }
  MURO_INLINE V3<S> column_z() const { return {xz, yz, zz}; }
};

template <class S>
MURO_INLINE Symmetric<S> scaled_identity(S s) {
  const S zero(0);
  return {s, s, s, zero, zero, zero};
}
/// v v^T
template <class S>
MURO_INLINE Symmetric<S> square(const V3<S>& v) {
  return {v.x * v.x, v.y * v.y, v.z * v.z, v.x * v.y, v.x * v.z, v.y * v.z};
}
/// a b^T + b a^T
template <class S>
MURO_INLINE Symmetric<S> mixed(const V3<S>& a, const V3<S>& b) {
  return {S(2) * a.x * b.x,      S(2) * a.y * b.y,      S(2) * a.z * b.z,
          a.x * b.y + a.y * b.x, a.x * b.z + a.z * b.x, a.y * b.z + a.z * b.y};
}
/// r m r^T
template <class S>
MURO_INLINE Symmetric<S> rotated(const M3<S>& r, const Symmetric<S>& m) {
  const V3<S> a = r * m.column_x(), b = r * m.column_y(), c = r * m.column_z();
  return {a.x * r.x.x + b.x * r.y.x + c.x * r.z.x, a.y * r.x.y + b.y * r.y.y + c.y * r.z.y,
          a.z * r.x.z + b.z * r.y.z + c.z * r.z.z, a.x * r.x.y + b.x * r.y.y + c.x * r.z.y,
          a.x * r.x.z + b.x * r.y.z + c.x * r.z.z, a.y * r.x.z + b.y * r.y.z + c.y * r.z.z};
}
/// c m c^T, where c v = n x v
template <class S>
MURO_INLINE Symmetric<S> crossed(const V3<S>& n, const Symmetric<S>& m) {
  const V3<S> a = cross(n, m.column_x()), b = cross(n, m.column_y()), c = cross(n, m.column_z());
  // rows of (a b c), crossed again
  return {n.y * c.x - n.z * b.x, n.z * a.y - n.x * c.y, n.x * b.z - n.y * a.z,
          n.z * a.x - n.x * c.x, n.x * b.x - n.y * a.x, n.x * b.y - n.y * a.y};
}

}  // namespace MURO_ISA
}  // namespace muro::penalty::law
