// SPDX-License-Identifier: MIT
// Loads and stores of 4-byte numbers that lie side by side in memory. Each lane has its own place.
#pragma once

#include <cstdint>

#include "muro/simd/rows.hpp"

namespace muro::native::lanes {
inline namespace MURO_ISA {

namespace detail {

/// Returns the last 52 bits of each element as a 64-bit number.
template <class Vector>
MURO_INLINE Vector last_bits(const Vector& v) {
  constexpr std::int64_t all = (std::int64_t(1) << 52) - 1;
  if constexpr (lane::vectors::is_pair<Vector>) {
    return {last_bits(v.low), last_bits(v.high)};
  } else if constexpr (std::is_same_v<Vector, double>) {
    return __builtin_bit_cast(double, __builtin_bit_cast(std::int64_t, v) & all);
  } else {
    using Bits = decltype(v < Vector{});
    return Vector(Bits(v) & all);
  }
}

typedef float Floats2 __attribute__((vector_size(8)));
typedef float Floats4 __attribute__((vector_size(16)));

/// Returns the numbers of `groups` from number `first` on, as many as `Vector` holds.
template <class Vector, int first = 0>
MURO_INLINE Vector widened(const Floats4* groups) {
  namespace vectors = lane::vectors;
  if constexpr (vectors::is_pair<Vector>) {
    using Half = decltype(Vector::low);
    return {widened<Half, first>(groups), widened<Half, first + vectors::length_of<Half>>(groups)};
  } else if constexpr (vectors::length_of<Vector> == 8) {
    return __builtin_convertvector(__builtin_shufflevector(groups[0], groups[1], 0, 1, 2, 3, 4, 5, 6, 7), Vector);
  } else if constexpr (vectors::length_of<Vector> == 4) {
    return __builtin_convertvector(groups[first / 4], Vector);
  } else {
    const Floats4& g = groups[first / 4];
    return __builtin_convertvector(__builtin_shufflevector(g, g, first % 4, first % 4 + 1), Vector);
  }
}

}  // namespace detail

/// Stores the whole numbers (0 to 2^51) that `s` holds, one to each place of `to`.
template <class S>
MURO_INLINE void store_whole(std::int64_t* to, const S& s) {
  const S sum = s + S(0x1p52);  // it has the number in its last 52 bits
  if constexpr (lane::count_of<S> == 1) {
    const double bits = detail::last_bits(sum);
    __builtin_memcpy(to, &bits, sizeof bits);
  } else {
    const S bits = detail::last_bits(sum.v);
    __builtin_memcpy(to, &bits, sizeof bits);
  }
}

/// Loads number k of each lane to `to[k]`. `four(place)` returns the four numbers of the lane that has `place` in `at`,
/// a whole number.
template <class S, class Four>
MURO_INLINE void load_fours(const S& at, const Four& four, S (&to)[4]) {
  using detail::Floats4;
  constexpr int count = lane::count_of<S>;
  std::int64_t places[count];
  store_whole(places, at);
  if constexpr (count == 1) {
    const Floats4 v = four(places[0]);
    for (int k = 0; k < 4; ++k) to[k] = double(v[k]);
  } else {
    Floats4 numbers[4][count / 4];
    for (int g = 0; g < count / 4; ++g) {
      const Floats4 a = four(places[4 * g]), b = four(places[4 * g + 1]), c = four(places[4 * g + 2]),
                    d = four(places[4 * g + 3]);
      const Floats4 ab = __builtin_shufflevector(a, b, 0, 4, 1, 5), cd = __builtin_shufflevector(c, d, 0, 4, 1, 5);
      const Floats4 ab2 = __builtin_shufflevector(a, b, 2, 6, 3, 7), cd2 = __builtin_shufflevector(c, d, 2, 6, 3, 7);
      numbers[0][g] = __builtin_shufflevector(ab, cd, 0, 1, 4, 5);
      numbers[1][g] = __builtin_shufflevector(ab, cd, 2, 3, 6, 7);
      numbers[2][g] = __builtin_shufflevector(ab2, cd2, 0, 1, 4, 5);
      numbers[3][g] = __builtin_shufflevector(ab2, cd2, 2, 3, 6, 7);
    }
    for (int k = 0; k < 4; ++k) to[k] = detail::widened<typename S::Vector>(numbers[k]);
  }
}

/// Returns the four numbers at a place.
MURO_INLINE detail::Floats4 four_at(const float* from) {
  detail::Floats4 v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}
/// Returns two numbers at one place, followed by two at another.
MURO_INLINE detail::Floats4 two_and_two(const float* first, const float* second) {
  detail::Floats2 a, b;
  __builtin_memcpy(&a, first, sizeof a);
  __builtin_memcpy(&b, second, sizeof b);
  return __builtin_shufflevector(a, b, 0, 1, 2, 3);
}

}  // namespace MURO_ISA
}  // namespace muro::native::lanes
