// SPDX-License-Identifier: MIT
// Turns over any scalar of muro/simd: those of single steps, and wide ones.
#pragma once

#include "muro/simd/geometry.hpp"
#include "muro/simd/trig.hpp"

namespace muro::lane {
inline namespace MURO_ISA {

/// Cosine, and half of sine by angle, of angles whose squares are x: where the series do not serve.
template <class S>
[[gnu::cold, gnu::noinline]] void turn_wide(const S& x, S& cosine, S& half_sinc) {
  const auto wide = x >= S(0.01);
  const S half = sqrt(x);
  const SinCos<S> exact = sincos(half);
  cosine = select(wide, exact.cos, cosine);
  half_sinc = select(wide, S(0.5) * exact.sin / half, half_sinc);
}

/// The rotation by the vector `v` (axis times angle, rad), as muro::rotation_of.
template <class S>
MURO_INLINE Q4<S> rotation_by(const V3<S>& v) {
  const S x = S(0.25) * dot(v, v), xx = x * x;  // square of the half angle
  // The series serve the turns of single steps, exact to the last digit.
  S c = (S(1) - S(0.5) * x) + xx * ((S(1.0 / 24) - S(1.0 / 720) * x) + xx * (S(1.0 / 40320) - S(1.0 / 3628800) * x));
  S s = (S(0.5) - S(1.0 / 12) * x) + xx * ((S(1.0 / 240) - S(1.0 / 10080) * x) + xx * S(1.0 / 725760));
  if (any(x >= S(0.01))) [[unlikely]] {
    S cosine = c, half_sinc = s;  // have addresses; c and s need not have one
    turn_wide(x, cosine, half_sinc);
    c = cosine, s = half_sinc;
  }
  return {s * v.x, s * v.y, s * v.z, c};
}

/// `q` turned by `by`, then brought back to length 1: one Newton step of the norm, which is all
/// that round-off needs.
template <class S>
MURO_INLINE Q4<S> turned(const Q4<S>& by, const Q4<S>& q) {
  const Q4<S> r = by * q;
  const S norm = S(1.5) - S(0.5) * (r.x * r.x + r.y * r.y + r.z * r.z + r.w * r.w);
  return {r.x * norm, r.y * norm, r.z * norm, r.w * norm};
}

}  // namespace MURO_ISA
}  // namespace muro::lane
