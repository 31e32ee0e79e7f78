// SPDX-License-Identifier: MIT
// Sine and cosine over any scalar of lane.hpp: the same bits for a double and for a lane, on every machine, which the
// functions of the C library do not promise.
#pragma once

#include <cmath>

#include "muro/lane/lane.hpp"

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

/// Sine and cosine of an angle (rad); error below 2^-52 up to 10^6, relative to 1. From there on the C library's,
/// value by value.
template <class S>
MURO_INLINE SinCos<S> sincos(S angle) {
  const S limit(1e6);
  // Cody and Waite, Software Manual for the Elementary Functions: pi/2 in parts whose products with k are exact.
  const S k = nearest(angle * S(0.63661977236758134308));
  S r = angle - k * S(0x1.921fb544p0);
  const S second = k * S(0x1.0b4611a6p-34), before = r;
  r = before - second;
  r = r - (k * S(0x1.3198a2e037073p-69) - ((before - r) - second));
  const S z = r * r;
  // Taylor series; |r| <= pi/4, so what is left out is below 2^-57.
  const S sine =
      r + r * z *
              (S(-1.0 / 6) +
               z * (S(1.0 / 120) +
                    z * (S(-1.0 / 5040) +
                         z * (S(1.0 / 362880) +
                              z * (S(-1.0 / 39916800) + z * (S(1.0 / 6227020800) + z * S(-1.0 / 1307674368000)))))));
  const S cosine =
      S(1) +
      z * (S(-0.5) +
           z * (S(1.0 / 24) +
                z * (S(-1.0 / 720) +
                     z * (S(1.0 / 40320) +
                          z * (S(-1.0 / 3628800) + z * (S(1.0 / 479001600) +
                                                        z * (S(-1.0 / 87178291200) + z * S(1.0 / 20922789888000))))))));
  const S quadrant = k - S(4) * nearest(k * S(0.25) - S(0.375));  // 0, 1, 2, 3
  const auto odd = (quadrant == S(1)) | (quadrant == S(3));
  const S s = select(odd, cosine, sine), c = select(odd, sine, cosine);
  SinCos<S> result{select(quadrant >= S(2), -s, s), select((quadrant == S(1)) | (quadrant == S(2)), -c, c)};
  if (const auto far = !(abs(angle) <= limit); any(far)) {
    if constexpr (count_of<S> == 1) {
      result = {S(std::sin(angle)), S(std::cos(angle))};
    } else {
      for (int i = 0; i < count_of<S>; ++i)
        if (bits(far) >> i & 1) result.sin.set(i, std::sin(angle[i])), result.cos.set(i, std::cos(angle[i]));
    }
  }
  return result;
}

}  // namespace MURO_ISA
}  // namespace muro::lane
