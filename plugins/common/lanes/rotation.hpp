// SPDX-License-Identifier: MIT
// Turns over any scalar of muro/simd: small turns of single steps, and wide turns.
#pragma once

#include "muro/simd/geometry.hpp"
#include "muro/simd/trig.hpp"

namespace muro::lane {
inline namespace MURO_ISA {

/// Computes the cosine, and half of sine by angle, of angles whose squares are x, where the series are not exact.
template <class S>
[[gnu::cold, gnu::noinline]] void turn_wide(const S& x, S& cosine, S& half_sinc) {
  const auto wide = x >= S(0.01);
  const S half = sqrt(x);
  const SinCos<S> exact = sincos(half);
  cosine = select(wide, exact.cos, cosine);
  half_sinc = select(wide, S(0.5) * exact.sin / half, half_sinc);
}

/// Returns the rotation by the vector `v` (axis times angle, rad), as muro::rotation_of does.
template <class S>
MURO_INLINE Q4<S> rotation_by(const V3<S>& v) {
  const S x = S(0.25) * dot(v, v), xx = x * x;  // square of the half angle
  // The series are for the turns of single steps, and exact to the last digit.
  S c = (S(1) - S(0.5) * x) + xx * ((S(1.0 / 24) - S(1.0 / 720) * x) + xx * (S(1.0 / 40320) - S(1.0 / 3628800) * x));
  S s = (S(0.5) - S(1.0 / 12) * x) + xx * ((S(1.0 / 240) - S(1.0 / 10080) * x) + xx * S(1.0 / 725760));
  if (any(x >= S(0.01))) [[unlikely]] {
    S cosine = c, half_sinc = s;  // these have addresses; c and s then need none
    turn_wide(x, cosine, half_sinc);
    c = cosine, s = half_sinc;
  }
  return {s * v.x, s * v.y, s * v.z, c};
}

/// Returns `q` turned by `by` and brought back to length 1 by one Newton step of the norm, which is enough for
/// round-off.
template <class S>
MURO_INLINE Q4<S> turned(const Q4<S>& by, const Q4<S>& q) {
  const Q4<S> r = by * q;
  const S norm = S(1.5) - S(0.5) * (r.x * r.x + r.y * r.y + r.z * r.z + r.w * r.w);
  return {r.x * norm, r.y * norm, r.z * norm, r.w * norm};
}

}  // namespace MURO_ISA
}  // namespace muro::lane
