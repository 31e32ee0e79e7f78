// SPDX-License-Identifier: MIT
// Sine and cosine over any scalar of lane.hpp. The bits are the same for a double and for a lane, on every machine, and
// the same as those of elementary::sincos (muro/base/elementary.hpp).
#pragma once

#include <sleef.h>

#include "muro/simd/lane.hpp"

namespace muro::lane {
inline namespace MURO_ISA {

template <class S>
struct SinCos {
  S sin, cos;
};

namespace detail {

/// Uses SLEEF's functions without fused multiply-add, which have equal bits for one number and for packs.
template <class Vector>
MURO_INLINE SinCos<Vector> sincos_of(const Vector& a) {
  if constexpr (vectors::is_pair<Vector>) {
    const auto low = sincos_of(a.low), high = sincos_of(a.high);
    return {{low.sin, high.sin}, {low.cos, high.cos}};
  } else {
#if defined(__AVX512F__)
    if constexpr (sizeof a == 64) {
      const Sleef___m512d_2 r = Sleef_cinz_sincosd8_u10avx512fnofma(__m512d(a));
      return {Vector(r.x), Vector(r.y)};
    }
#endif
#if defined(__AVX__)
    if constexpr (sizeof a == 32) {
      const Sleef___m256d_2 r = Sleef_cinz_sincosd4_u10avx(__m256d(a));
      return {Vector(r.x), Vector(r.y)};
    }
#endif
#if defined(__x86_64__)
    if constexpr (sizeof a == 16) {
      const Sleef___m128d_2 r = Sleef_cinz_sincosd2_u10sse2(__m128d(a));
      return {Vector(r.x), Vector(r.y)};
    }
#endif
    SinCos<Vector> both{};
    for (int i = 0; i < vectors::length_of<Vector>; ++i) {
      const auto r = Sleef_cinz_sincosd1_u10purec(a[i]);
      both.sin[i] = r.x, both.cos[i] = r.y;
    }
    return both;
  }
}

}  // namespace detail

/// Sine and cosine of an angle (rad), each at most 1 ulp from the true value.
template <class S>
MURO_INLINE SinCos<S> sincos(S angle) {
  if constexpr (count_of<S> == 1) {
    const auto r = Sleef_cinz_sincosd1_u10purec(angle);
    return {r.x, r.y};
  } else {
    const auto r = detail::sincos_of(angle.v);
    return {r.sin, r.cos};
  }
}

}  // namespace MURO_ISA
}  // namespace muro::lane
