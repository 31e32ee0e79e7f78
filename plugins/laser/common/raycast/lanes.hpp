// SPDX-License-Identifier: MIT
// Lanes of sixteen floats, or of sixteen doubles in two lanes.
#pragma once

#include <cstdint>

#include "muro/simd/geometry.hpp"

namespace muro::raycast::rays {
inline namespace MURO_ISA {

using D = lane::Double8;
using F = lane::Float16;
using I = lane::Lane<std::int32_t, 16>;

namespace detail {

using namespace lane::vectors;

template <class Vector>
MURO_INLINE Vector load_at(const Element<Vector>* from) {
  if constexpr (is_pair<Vector>) {
    using Half = decltype(Vector::low);
    return {load_at<Half>(from), load_at<Half>(from + length_of<Half>)};
  } else {
    Vector v;
    __builtin_memcpy(&v, from, sizeof v);
    return v;
  }
}
template <class Vector>
MURO_INLINE void store_at(Element<Vector>* to, const Vector& v) {
  if constexpr (is_pair<Vector>) {
    store_at(to, v.low);
    store_at(to + length_of<Vector> / 2, v.high);
  } else {
    __builtin_memcpy(to, &v, sizeof v);
  }
}
template <class Floats, class Doubles, int... i>
MURO_INLINE Floats joined(const Doubles& a, const Doubles& b, std::integer_sequence<int, i...>) {
  typedef float Half __attribute__((vector_size(sizeof(Floats) / 2)));
  return __builtin_shufflevector(__builtin_convertvector(a, Half), __builtin_convertvector(b, Half), i...);
}
template <class Floats, class Doubles>
MURO_INLINE Floats narrowed(const Doubles& a, const Doubles& b) {
  if constexpr (is_pair<Floats>) {
    using Half = decltype(Floats::low);
    return {narrowed<Half>(a.low, a.high), narrowed<Half>(b.low, b.high)};
  } else {
    return joined<Floats>(a, b, std::make_integer_sequence<int, length_of<Floats>>());
  }
}
template <class Vector>
MURO_INLINE auto sign_bits(const Vector& v) {
  if constexpr (is_pair<Vector>) {
    return pair_of(sign_bits(v.low), sign_bits(v.high));
  } else {
    using Bits = decltype(v < Vector{});
    return Bits(v) & Bits(-Vector{});
  }
}

template <class To, class From>
MURO_INLINE To converted(const From& v) {
  if constexpr (is_pair<From>) {
    using Half = decltype(To::low);
    return {converted<Half>(v.low), converted<Half>(v.high)};
  } else {
    return __builtin_convertvector(v, To);
  }
}
}  // namespace detail

/// Reads a lane of consecutive numbers.
template <class S>
MURO_INLINE S load(const typename lane::Traits<S>::Value* from) {
  return detail::load_at<typename S::Vector>(from);
}
template <class S>
MURO_INLINE void store(typename lane::Traits<S>::Value* to, S value) {
  detail::store_at<typename S::Vector>(to, value.v);
}

/// Rounds towards zero.
MURO_INLINE I truncated(F a) { return detail::converted<I::Vector>(a.v); }
MURO_INLINE F to_floats(I a) { return detail::converted<F::Vector>(a.v); }
/// Returns the greatest whole number that is not greater than `a`; for numbers of less than 2^51.
MURO_INLINE D floor(D a) {
  const D big(0x1.8p52), near = (a + big) - big;
  return lane::select(near > a, near - D(1), near);
}

/// Sixteen elements of 64 bits, found by their numbers: the first 32 bits, and the last 32 bits as two numbers.
struct Places64 {
  F first;
  I second, third;
};
MURO_INLINE Places64 look_up(const void* from, I number) {
#if defined(__AVX512F__)
  alignas(64) std::int32_t at[16];
  store(at, number);
  const auto of = [&](int i) { return static_cast<const long long*>(from)[at[i]]; };
  const __m512i a = _mm512_setr_epi64(of(0), of(1), of(2), of(3), of(4), of(5), of(6), of(7));
  const __m512i b = _mm512_setr_epi64(of(8), of(9), of(10), of(11), of(12), of(13), of(14), of(15));
  const I::Vector x = I::Vector(a), y = I::Vector(b);
  const I::Vector first = __builtin_shufflevector(x, y, 0, 2, 4, 6, 8, 10, 12, 14, 16, 18, 20, 22, 24, 26, 28, 30);
  const I::Vector last = __builtin_shufflevector(x, y, 1, 3, 5, 7, 9, 11, 13, 15, 17, 19, 21, 23, 25, 27, 29, 31);
  return {F(F::Vector(first)), I(I::Vector(last << 16 >> 16)), I(I::Vector(last >> 16))};
#else
  alignas(64) std::int32_t at[16], second[16], third[16];
  alignas(64) float first[16];
  store(at, number);
  for (int i = 0; i < 16; ++i) {
    const char* place = static_cast<const char*>(from) + 8 * std::ptrdiff_t(at[i]);
    std::int16_t last[2];
    __builtin_memcpy(&first[i], place, 4);
    __builtin_memcpy(last, place + 4, 4);
    second[i] = last[0], third[i] = last[1];
  }
  return {load<F>(first), load<I>(second), load<I>(third)};
#endif
}

/// The elements `number` and `number` + 1 of an array.
struct TwoPlaces {
  D first, second;
};
MURO_INLINE TwoPlaces look_up_two(const float* from, D number) {
#if defined(__AVX512F__)
  alignas(64) std::int64_t at[8];
  const __m512i numbers = _mm512_cvttpd_epi64(__m512d(number.v));
  __builtin_memcpy(at, &numbers, sizeof at);
  const auto of = [&](int i) {
    long long two;
    __builtin_memcpy(&two, from + at[i], sizeof two);
    return two;
  };
  const __m512i both = _mm512_setr_epi64(of(0), of(1), of(2), of(3), of(4), of(5), of(6), of(7));
  const auto doubles = [](__m512i low) {
    return D(D::Vector(_mm512_cvtps_pd(_mm256_castsi256_ps(_mm512_cvtepi64_epi32(low)))));
  };
  return {doubles(both), doubles(_mm512_srli_epi64(both, 32))};
#else
  alignas(64) double at[8], first[8], second[8];
  store(at, number);
  for (int i = 0; i < 8; ++i) {
    const float* place = from + std::int64_t(at[i]);
    first[i] = double(place[0]), second[i] = double(place[1]);
  }
  return {load<D>(first), load<D>(second)};
#endif
}

/// Rounds to floats.
MURO_INLINE F narrow(D first, D second) { return detail::narrowed<F::Vector>(first.v, second.v); }

/// Returns the signs as bits: bit i is set if value i is negative.
MURO_INLINE unsigned signs(F a) { return detail::bits_of(detail::sign_bits(a.v)); }
inline constexpr unsigned all_signs = 0xffff;

}  // namespace MURO_ISA
}  // namespace muro::raycast::rays
