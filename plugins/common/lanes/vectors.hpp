// SPDX-License-Identifier: MIT
// Conversions of vectors and matrices between the SDK and lanes.
#pragma once

#include "muro/geometry.hpp"
#include "muro/simd/geometry.hpp"

namespace muro {

inline lane::V3<double> plain(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline Vec3 vector_of(const lane::V3<double>& v) { return {v.x, v.y, v.z}; }
inline lane::M3<double> columns_of(const Mat3& m) {
  return {plain(Vec3(m.col(0))), plain(Vec3(m.col(1))), plain(Vec3(m.col(2)))};
}
inline Mat3 matrix_of(const lane::M3<double>& m) {
  Mat3 r;
  r << vector_of(m.x), vector_of(m.y), vector_of(m.z);
  return r;
}

}  // namespace muro
