// SPDX-License-Identifier: MIT
// Sine and cosine over any scalar of lane.hpp: the same bits for a double and for a lane, on every machine, which the
// functions of the C library do not promise.
#pragma once

#include <cmath>

#include "muro/simd/lane.hpp"

namespace muro::lane {
inline namespace MURO_ISA {

template <class S>
struct SinCos {
  S sin, cos;
};

/// The nearest whole number, for |a| < 2^51.
template <class S>
MURO_INLINE S nearest(S a) {
  const S big(0x1.8p52);
  return (a + big) - big;
}

/// Beyond the reach of sincos: the C library's.
[[gnu::cold, gnu::noinline]] inline void sincos_far(double angle, double& sin, double& cos) {
  sin = std::sin(angle);
  cos = std::cos(angle);
}

/// Sine and cosine of an angle (rad); error below 2^-52 up to 10^6, relative to 1. From there on the C library's,
/// value by value.
template <class S>
MURO_INLINE SinCos<S> sincos(S angle) {
  // Cody and Waite, Software Manual for the Elementary Functions: pi/2 in parts, of which the first has 33 bits, so its
  // product with k is exact. The last bits of `whole` are those of k.
  const S big(0x1.8p52), whole = angle * S(0x1.45f306dc9c883p-1) + big, k = whole - big;
  const S r = (angle - k * S(0x1.921fb544p0)) - k * S(0x1.0b4611a626331p-34), z = r * r;
  // Minimax polynomials for |r| <= pi/4, found by Remez' exchange: errors 2^-59 and 2^-64. Pairs of terms, for they do
  // not wait for each other (Estrin).
  const S zz = z * z;
  const S s01 = S(-0x1.555555555553dp-3) + z * S(0x1.111111110eb1ap-7);
  const S s23 = S(-0x1.a01a019ab4225p-13) + z * S(0x1.71de3474f29dfp-19);
  const S s45 = S(-0x1.ae5db422cab22p-26) + z * S(0x1.5d64b1076d5ddp-33);
  const S c01 = S(0x1.555555555554cp-5) + z * S(-0x1.6c16c16c15181p-10);
  const S c23 = S(0x1.a01a019cb216cp-16) + z * S(-0x1.27e4f80a33d96p-22);
  const S c45 = S(0x1.1ee9ec18b5e69p-29) + z * S(-0x1.8faeb5fa1872bp-37);
  const S sine = r + r * z * (s01 + zz * (s23 + zz * s45));
  const S cosine = (S(1) - S(0.5) * z) + zz * (c01 + zz * (c23 + zz * c45));
  const auto odd = has_bit(whole, 0);
  SinCos<S> result{flip_sign(select(odd, cosine, sine), whole, 1),
                   flip_sign(select(odd, sine, cosine), whole + S(1), 1)};
  const auto far = !(abs(angle) <= S(1e6));
  if (any(far)) [[unlikely]] {
    if constexpr (count_of<S> == 1) {
      sincos_far(angle, result.sin, result.cos);
    } else {
      for (int i = 0; i < count_of<S>; ++i) {
        if (!(bits(far) >> i & 1)) continue;
        double s = 0, c = 0;
        sincos_far(angle[i], s, c);
        result.sin.set(i, s), result.cos.set(i, c);
      }
    }
  }
  return result;
}

}  // namespace MURO_ISA
}  // namespace muro::lane
