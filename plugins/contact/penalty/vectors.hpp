// SPDX-License-Identifier: MIT
// Vectors of the SDK as those of the contact law, and back.
#pragma once

#include "muro/geometry.hpp"
#include "muro/simd/geometry.hpp"

namespace muro::penalty {

inline lane::V3<double> plain(const Vec3& v) { return {v.x(), v.y(), v.z()}; }
inline Vec3 vector_of(const lane::V3<double>& v) { return {v.x, v.y, v.z}; }

}  // namespace muro::penalty
