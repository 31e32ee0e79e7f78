// SPDX-License-Identifier: MIT
// Vectors, matrices and rotations over any scalar of lane.hpp.
#pragma once

#include "muro/simd/lane.hpp"

namespace muro::lane {
inline namespace MURO_ISA {

template <class S>
struct V3 {
  S x, y, z;

  MURO_INLINE V3 operator-() const { return {-x, -y, -z}; }
  MURO_INLINE V3& operator+=(const V3& b) { return x += b.x, y += b.y, z += b.z, *this; }
  MURO_INLINE V3& operator-=(const V3& b) { return x -= b.x, y -= b.y, z -= b.z, *this; }
  MURO_INLINE friend V3 operator+(const V3& a, const V3& b) { return {a.x + b.x, a.y + b.y, a.z + b.z}; }
  MURO_INLINE friend V3 operator-(const V3& a, const V3& b) { return {a.x - b.x, a.y - b.y, a.z - b.z}; }
  MURO_INLINE friend V3 operator*(const V3& a, S s) { return {a.x * s, a.y * s, a.z * s}; }
  MURO_INLINE friend V3 operator*(S s, const V3& a) { return {s * a.x, s * a.y, s * a.z}; }
};

template <class S>
MURO_INLINE S dot(const V3<S>& a, const V3<S>& b) {
  return a.x * b.x + a.y * b.y + a.z * b.z;
}
template <class S>
MURO_INLINE V3<S> cross(const V3<S>& a, const V3<S>& b) {
  return {a.y * b.z - a.z * b.y, a.z * b.x - a.x * b.z, a.x * b.y - a.y * b.x};
}
template <class S, class M>
MURO_INLINE V3<S> select(M m, const V3<S>& a, const V3<S>& b) {
  return {select(m, a.x, b.x), select(m, a.y, b.y), select(m, a.z, b.z)};
}
/// Sets each lane to the same value.
template <class S, class Vector>
MURO_INLINE V3<S> splat(const Vector& v) {
  return {S(v[0]), S(v[1]), S(v[2])};
}

/// A matrix by its columns.
template <class S>
struct M3 {
  V3<S> x, y, z;

  MURO_INLINE friend V3<S> operator*(const M3& m, const V3<S>& v) { return m.x * v.x + m.y * v.y + m.z * v.z; }
  MURO_INLINE friend M3 operator*(const M3& a, const M3& b) { return {a * b.x, a * b.y, a * b.z}; }
};
/// The transposed matrix times v.
template <class S>
MURO_INLINE V3<S> transposed_times(const M3<S>& m, const V3<S>& v) {
  return {dot(m.x, v), dot(m.y, v), dot(m.z, v)};
}

/// A unit quaternion.
template <class S>
struct Q4 {
  S x, y, z, w;

  MURO_INLINE friend Q4 operator*(const Q4& a, const Q4& b) {
    return {a.w * b.x + a.x * b.w + a.y * b.z - a.z * b.y, a.w * b.y + a.y * b.w + a.z * b.x - a.x * b.z,
            a.w * b.z + a.z * b.w + a.x * b.y - a.y * b.x, a.w * b.w - a.x * b.x - a.y * b.y - a.z * b.z};
  }
  MURO_INLINE M3<S> matrix() const {
    const S tx = S(2) * x, ty = S(2) * y, tz = S(2) * z, one(1);
    const S wx = tx * w, wy = ty * w, wz = tz * w, xx = tx * x, xy = ty * x, xz = tz * x, yy = ty * y, yz = tz * y,
            zz = tz * z;
    return {
        {one - (yy + zz), xy + wz, xz - wy}, {xy - wz, one - (xx + zz), yz + wx}, {xz + wy, yz - wx, one - (xx + yy)}};
  }
};

/// Properties of type Pose and Twist as numbers: position x y z, orientation x y z w; linear, angular. A Wrench has
/// force and torque, a Vec3 three numbers.
template <class S>
struct PoseOf {
  V3<S> position;
  Q4<S> orientation;
};
template <class S>
struct TwistOf {
  V3<S> linear, angular;
};

}  // namespace MURO_ISA
}  // namespace muro::lane
