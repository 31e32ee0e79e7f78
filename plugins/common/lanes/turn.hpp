// SPDX-License-Identifier: MIT
// Cosine and sine of the angles of joints. They take a tenth of a step, so this uses fewer operations than a library
// that takes every angle. A double and a lane give the same bits, as in all that lanes calculate.
#pragma once

#include "muro/simd/rows.hpp"
#include "muro/simd/trig.hpp"

namespace muro::lane {
inline namespace MURO_ISA {

/// Cosine and sine of an angle.
template <class S>
struct Turn {
  S c, s;
};

namespace detail {

/// Computes the turn by x, |x| < most_turn: reduces x by multiples of a right angle in two parts (Cody and Waite), then
/// uses the polynomials of fdlibm (k_sin.c, k_cos.c). The error is within 1.5 ulp of 1.
inline constexpr double most_turn = 1e6;  // rad
template <class S>
MURO_INLINE Turn<S> turn_by_less(S x) {
  constexpr double to_integer = 6755399441055744.0;  // 1.5 * 2^52: a number that is added to it is rounded
  const S magic(to_integer);
  const S k = (x * S(0.63661977236758134308) + magic) - magic;
  const S r = (x - k * S(1.57079632673412561417)) - k * S(6.07710050650619224932e-11), z = r * r;
  const S s = r + r * z *
                      (S(-1.66666666666666324348e-01) +
                       z * (S(8.33333333332248946124e-03) +
                            z * (S(-1.98412698298579493134e-04) +
                                 z * (S(2.75573137070700676789e-06) +
                                      z * (S(-2.50507602534068634195e-08) + z * S(1.58969099521155010221e-10))))));
  const S c = (S(1) - S(0.5) * z) +
              z * z *
                  (S(4.16666666666666019037e-02) +
                   z * (S(-1.38888888888741095749e-03) +
                        z * (S(2.48015872894767294178e-05) +
                             z * (S(-2.75573143513906633035e-07) +
                                  z * (S(2.08757232129817482790e-09) + z * S(-1.13596475577881948265e-11))))));
  // which quarter: 0, 1/4, -1/2 or 1/2, -1/4 of a turn
  const S turns = k * S(0.25), quarter = turns - ((turns + magic) - magic);
  const MaskOf<S> is_odd = abs(quarter) == S(0.25), is_half = abs(quarter) == S(0.5);
  const S sine = select(is_odd, c, s), cosine = select(is_odd, s, c);
  return {select(is_half | (quarter == S(0.25)), -cosine, cosine),
          select(is_half | (quarter == S(-0.25)), -sine, sine)};
}

}  // namespace detail

template <class S>
MURO_INLINE Turn<S> turn_by(S angle) {
  Turn<S> t = detail::turn_by_less(angle);
  const MaskOf<S> is_less = abs(angle) < S(detail::most_turn);
  if (bits(is_less) != all_lanes<S>) {
    const auto far = sincos(angle);
    t = {select(is_less, t.c, far.cos), select(is_less, t.s, far.sin)};
  }
  return t;
}

}  // namespace MURO_ISA
}  // namespace muro::lane
