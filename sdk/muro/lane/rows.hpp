// SPDX-License-Identifier: MIT
// Up to eight numbers that lie side by side, at one place a lane: read or written as rows, which for a lane of eight is
// a transposition of eight by eight in registers.
#pragma once

#include "muro/lane/geometry.hpp"

namespace muro::lane {
inline namespace MURO_ISA {

#if defined(__AVX512F__)
/// By pairs, then by fours, then by eights.
template <class Vector>
MURO_INLINE void transpose(Vector (&r)[8]) {
  Vector two[8], four[8];
  for (int i = 0; i < 8; i += 2) {
    two[i] = __builtin_shufflevector(r[i], r[i + 1], 0, 8, 2, 10, 4, 12, 6, 14);
    two[i + 1] = __builtin_shufflevector(r[i], r[i + 1], 1, 9, 3, 11, 5, 13, 7, 15);
  }
  for (int i = 0; i < 8; i += 4)
    for (int k = i; k < i + 2; ++k) {
      four[k] = __builtin_shufflevector(two[k], two[k + 2], 0, 1, 4, 5, 8, 9, 12, 13);
      four[k + 2] = __builtin_shufflevector(two[k], two[k + 2], 2, 3, 6, 7, 10, 11, 14, 15);
    }
  for (int k = 0; k < 4; ++k) {
    r[k] = __builtin_shufflevector(four[k], four[k + 4], 0, 1, 4, 5, 8, 9, 12, 13);
    r[k + 4] = __builtin_shufflevector(four[k], four[k + 4], 2, 3, 6, 7, 10, 11, 14, 15);
  }
}
#endif

/// Numbers that lie as the values of S do.
template <class S>
MURO_INLINE S load_side_by_side(const double* from) {
  S value;
  __builtin_memcpy(&value, from, sizeof value);
  return value;
}
template <class S>
MURO_INLINE void store_side_by_side(double* to, S value) {
  __builtin_memcpy(to, &value, sizeof value);
}

/// Numbers `first` to `first` + n - 1 of each place; n <= 8.
template <int n, class S>
MURO_INLINE void load_rows(const Places<S>& from, int first, S (&to)[n]) {
#if defined(__AVX512F__)
  if constexpr (count_of<S> == 8) {
    typename S::Vector rows[8];
    for (int i = 0; i < 8; ++i)
      rows[i] = typename S::Vector(_mm512_maskz_loadu_pd(__mmask8((1 << n) - 1), from.at[i] + first));
    transpose(rows);
    for (int k = 0; k < n; ++k) to[k] = rows[k];
    return;
  }
#endif
  for (int k = 0; k < n; ++k) to[k] = load<S>(from, first + k);
}

/// To n numbers of each place, from number `first` on, of those lanes whose bit is set in `which`.
template <int n, class S>
MURO_INLINE void store_rows(const Places<S, double>& to, std::int64_t first, const S (&from)[n], unsigned which) {
#if defined(__AVX512F__)
  if constexpr (count_of<S> == 8) {
    typename S::Vector rows[8] = {};
    for (int k = 0; k < n; ++k) rows[k] = from[k].v;
    transpose(rows);
    const auto store = [&](int i) {
      _mm512_mask_storeu_pd(to.at[i] + first, __mmask8((1 << n) - 1), __m512d(rows[i]));
    };
    if (which == 0xff) {
      for (int i = 0; i < 8; ++i) store(i);
    } else {
      for (int i = 0; i < 8; ++i)
        if (which >> i & 1) store(i);
    }
    return;
  }
#endif
  for (int k = 0; k < n; ++k)
    for (int i = 0; i < count_of<S>; ++i)
      if (which >> i & 1) {
        if constexpr (count_of<S> == 1)
          to.at[i][first + k] = from[k];
        else
          to.at[i][first + k] = from[k][i];
      }
}

}  // namespace MURO_ISA
}  // namespace muro::lane
