// SPDX-License-Identifier: MIT
// The compiler's vectors, in registers or in pairs of registers; lane.hpp is built on them.
#pragma once

#include <cstddef>
#include <type_traits>
#include <utility>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#ifndef MURO_ISA
#define MURO_ISA base
#endif
#define MURO_INLINE [[gnu::always_inline]] inline
/// Whether comparisons give bits in separate mask registers.
#if defined(__AVX512F__) && defined(__AVX512DQ__) && defined(__AVX512VL__)
#define MURO_HAS_MASK_REGISTERS 1
#else
#define MURO_HAS_MASK_REGISTERS 0
#endif

namespace muro::lane {
inline namespace MURO_ISA {
namespace vectors {

/// Bytes in the widest register of the instruction set.
#if defined(__AVX512F__)
inline constexpr int register_bytes = 64;
#elif defined(__AVX__)
inline constexpr int register_bytes = 32;
#else
inline constexpr int register_bytes = 16;
#endif

template <class Half>
struct Pair;

/// N values of T: one register, or a pair of halves. (The compiler's own vectors may be longer than a register, but
/// then it compares and chooses value by value.)
template <class T, int N, bool one_register = (N * sizeof(T) <= register_bytes)>
struct VectorOf {
  using Type = Pair<typename VectorOf<T, N / 2>::Type>;
};
template <class T, int N>
struct VectorOf<T, N, true> {
  typedef T Type __attribute__((vector_size(N * sizeof(T))));
};

template <class Half>
MURO_INLINE Pair<Half> pair_of(Half low, Half high);

template <class Half>
struct Pair {
  Half low, high;

  MURO_INLINE Pair operator-() const { return {-low, -high}; }
  MURO_INLINE Pair operator~() const { return {~low, ~high}; }
  MURO_INLINE friend Pair operator+(Pair a, Pair b) { return {a.low + b.low, a.high + b.high}; }
  MURO_INLINE friend Pair operator-(Pair a, Pair b) { return {a.low - b.low, a.high - b.high}; }
  MURO_INLINE friend Pair operator*(Pair a, Pair b) { return {a.low * b.low, a.high * b.high}; }
  MURO_INLINE friend Pair operator/(Pair a, Pair b) { return {a.low / b.low, a.high / b.high}; }
  MURO_INLINE friend Pair operator&(Pair a, Pair b) { return {a.low & b.low, a.high & b.high}; }
  MURO_INLINE friend Pair operator|(Pair a, Pair b) { return {a.low | b.low, a.high | b.high}; }
  MURO_INLINE friend auto operator<(Pair a, Pair b) { return pair_of(a.low < b.low, a.high < b.high); }
  MURO_INLINE friend auto operator<=(Pair a, Pair b) { return pair_of(a.low <= b.low, a.high <= b.high); }
  MURO_INLINE friend auto operator>(Pair a, Pair b) { return pair_of(a.low > b.low, a.high > b.high); }
  MURO_INLINE friend auto operator>=(Pair a, Pair b) { return pair_of(a.low >= b.low, a.high >= b.high); }
  MURO_INLINE friend auto operator==(Pair a, Pair b) { return pair_of(a.low == b.low, a.high == b.high); }
};
template <class Half>
MURO_INLINE Pair<Half> pair_of(Half low, Half high) {
  return {low, high};
}

template <class Vector>
inline constexpr bool is_pair = false;
template <class Half>
inline constexpr bool is_pair<Pair<Half>> = true;

/// The type of one element of a vector.
template <class Vector>
struct ElementOf {
  using Type = std::remove_cvref_t<decltype(Vector{}[0])>;
};
template <class Half>
struct ElementOf<Pair<Half>> : ElementOf<Half> {};
template <class Vector>
using Element = typename ElementOf<Vector>::Type;
template <class Vector>
inline constexpr int length_of = sizeof(Vector) / sizeof(Element<Vector>);

template <class Vector>
MURO_INLINE Element<Vector> get(const Vector& v, int i) {
  if constexpr (is_pair<Vector>)
    return i < length_of<Vector> / 2 ? get(v.low, i) : get(v.high, i - length_of<Vector> / 2);
  else
    return v[i];
}
template <class Vector>
MURO_INLINE void set(Vector& v, int i, Element<Vector> x) {
  if constexpr (is_pair<Vector>)
    i < length_of<Vector> / 2 ? set(v.low, i, x) : set(v.high, i - length_of<Vector> / 2, x);
  else
    v[i] = x;
}
/// Sets every place to x.
template <class Vector>
MURO_INLINE Vector splat(Element<Vector> x) {
  if constexpr (is_pair<Vector>)
    return {splat<decltype(Vector::low)>(x), splat<decltype(Vector::low)>(x)};
  else
    return x - Vector{};  // keeps the sign of a zero; 0 + x would not
}
/// Sets element i to number k of the array at[i].
template <class Vector, int... i>
MURO_INLINE Vector gather_into(const Element<Vector>* const* at, std::ptrdiff_t k, std::integer_sequence<int, i...>) {
  return Vector{at[i][k]...};
}
template <class Vector>
MURO_INLINE Vector gather(const Element<Vector>* const* at, std::ptrdiff_t k) {
  if constexpr (is_pair<Vector>) {
    using Half = decltype(Vector::low);
    return {gather<Half>(at, k), gather<Half>(at + length_of<Half>, k)};
  } else {
    return gather_into<Vector>(at, k, std::make_integer_sequence<int, length_of<Vector>>());
  }
}
#if MURO_HAS_MASK_REGISTERS
/// A comparison of two values. The numbers are those of the instruction set, for floating-point and for whole numbers.
enum class Comparison { less, less_or_equal, greater, greater_or_equal, equal };

/// Bit i of the result: whether element i of `a` compares so with element i of `b`.
template <Comparison c, class Vector>
MURO_INLINE unsigned compare(const Vector& a, const Vector& b) {
  constexpr int real[] = {_CMP_LT_OS, _CMP_LE_OS, _CMP_GT_OS, _CMP_GE_OS, _CMP_EQ_OQ};
  constexpr int whole[] = {_MM_CMPINT_LT, _MM_CMPINT_LE, _MM_CMPINT_NLE, _MM_CMPINT_NLT, _MM_CMPINT_EQ};
  using T = Element<Vector>;
  if constexpr (std::is_same_v<T, double>) {
    if constexpr (sizeof a == 64) return _mm512_cmp_pd_mask(__m512d(a), __m512d(b), real[int(c)]);
    if constexpr (sizeof a == 32) return _mm256_cmp_pd_mask(__m256d(a), __m256d(b), real[int(c)]);
    if constexpr (sizeof a == 16) return _mm_cmp_pd_mask(__m128d(a), __m128d(b), real[int(c)]);
  } else if constexpr (std::is_same_v<T, float>) {
    if constexpr (sizeof a == 64) return _mm512_cmp_ps_mask(__m512(a), __m512(b), real[int(c)]);
    if constexpr (sizeof a == 32) return _mm256_cmp_ps_mask(__m256(a), __m256(b), real[int(c)]);
    if constexpr (sizeof a == 16) return _mm_cmp_ps_mask(__m128(a), __m128(b), real[int(c)]);
  } else {
    static_assert(sizeof(T) == 4 && sizeof a == 64);
    return _mm512_cmp_epi32_mask(__m512i(a), __m512i(b), whole[int(c)]);
  }
}
/// Returns `a` where the bit is set, `b` elsewhere.
template <class Vector>
MURO_INLINE Vector choose_by_bits(unsigned bits, const Vector& a, const Vector& b) {
  using T = Element<Vector>;
  if constexpr (std::is_same_v<T, double>) {
    if constexpr (sizeof a == 64) return Vector(_mm512_mask_blend_pd(__mmask8(bits), __m512d(b), __m512d(a)));
    if constexpr (sizeof a == 32) return Vector(_mm256_mask_blend_pd(__mmask8(bits), __m256d(b), __m256d(a)));
    if constexpr (sizeof a == 16) return Vector(_mm_mask_blend_pd(__mmask8(bits), __m128d(b), __m128d(a)));
  } else if constexpr (std::is_same_v<T, float>) {
    if constexpr (sizeof a == 64) return Vector(_mm512_mask_blend_ps(__mmask16(bits), __m512(b), __m512(a)));
    if constexpr (sizeof a == 32) return Vector(_mm256_mask_blend_ps(__mmask8(bits), __m256(b), __m256(a)));
    if constexpr (sizeof a == 16) return Vector(_mm_mask_blend_ps(__mmask8(bits), __m128(b), __m128(a)));
  } else {
    static_assert(sizeof(T) == 4 && sizeof a == 64);
    return Vector(_mm512_mask_blend_epi32(__mmask16(bits), __m512i(b), __m512i(a)));
  }
}
/// The lesser and the greater value; `b` when they are equal or one is NaN.
template <class Vector>
MURO_INLINE Vector lesser(const Vector& a, const Vector& b) {
  if constexpr (std::is_same_v<Element<Vector>, double> && sizeof a == 64)
    return Vector(_mm512_min_pd(__m512d(a), __m512d(b)));
  else if constexpr (std::is_same_v<Element<Vector>, double> && sizeof a == 32)
    return Vector(_mm256_min_pd(__m256d(a), __m256d(b)));
  else if constexpr (std::is_same_v<Element<Vector>, float> && sizeof a == 64)
    return Vector(_mm512_min_ps(__m512(a), __m512(b)));
  else
    return choose_by_bits(compare<Comparison::less>(a, b), a, b);
}
template <class Vector>
MURO_INLINE Vector greater(const Vector& a, const Vector& b) {
  if constexpr (std::is_same_v<Element<Vector>, double> && sizeof a == 64)
    return Vector(_mm512_max_pd(__m512d(a), __m512d(b)));
  else if constexpr (std::is_same_v<Element<Vector>, double> && sizeof a == 32)
    return Vector(_mm256_max_pd(__m256d(a), __m256d(b)));
  else if constexpr (std::is_same_v<Element<Vector>, float> && sizeof a == 64)
    return Vector(_mm512_max_ps(__m512(a), __m512(b)));
  else
    return choose_by_bits(compare<Comparison::greater>(a, b), a, b);
}
#endif

/// Returns `a` where the mask (of integers) is set, `b` elsewhere.
template <class Mask, class Vector>
MURO_INLINE Vector choose(const Mask& m, const Vector& a, const Vector& b) {
  if constexpr (is_pair<Vector>)
    return {choose(m.low, a.low, b.low), choose(m.high, a.high, b.high)};
  else
    return m ? a : b;
}
/// Removes the signs.
template <class Vector>
MURO_INLINE Vector magnitude(const Vector& v) {
  if constexpr (is_pair<Vector>) {
    return {magnitude(v.low), magnitude(v.high)};
  } else {
    using Bits = decltype(v < Vector{});
    return Vector(Bits(v) & ~Bits(-Vector{}));
  }
}
/// Bit i: whether element i of the mask is set.
template <class Mask>
MURO_INLINE unsigned bits_of(const Mask& m) {
  if constexpr (is_pair<Mask>) {
    return bits_of(m.low) | bits_of(m.high) << length_of<Mask> / 2;
  } else {
    [[maybe_unused]] constexpr bool eight_bytes = sizeof(Element<Mask>) == 8;
#if defined(__AVX512DQ__)
    if constexpr (sizeof m == 64 && eight_bytes) return _mm512_movepi64_mask(__m512i(m));
    if constexpr (sizeof m == 64 && !eight_bytes) return _mm512_movepi32_mask(__m512i(m));
#endif
#if defined(__AVX__)
    if constexpr (sizeof m == 32 && eight_bytes) return unsigned(_mm256_movemask_pd(__m256d(m)));
    if constexpr (sizeof m == 32 && !eight_bytes) return unsigned(_mm256_movemask_ps(__m256(m)));
#endif
#if defined(__x86_64__)
    if constexpr (sizeof m == 16 && eight_bytes) return unsigned(_mm_movemask_pd(__m128d(m)));
    if constexpr (sizeof m == 16 && !eight_bytes) return unsigned(_mm_movemask_ps(__m128(m)));
#endif
    unsigned all = 0;
    for (int i = 0; i < length_of<Mask>; ++i) all |= unsigned(m[i] != 0) << i;
    return all;
  }
}
template <class Vector>
MURO_INLINE Vector root(const Vector& a) {
  if constexpr (is_pair<Vector>) {
    return {root(a.low), root(a.high)};
  } else {
    [[maybe_unused]] constexpr bool doubles = std::is_same_v<Element<Vector>, double>;
#if defined(__AVX512F__)
    if constexpr (sizeof a == 64 && doubles) return Vector(_mm512_sqrt_pd(__m512d(a)));
    if constexpr (sizeof a == 64 && !doubles) return Vector(_mm512_sqrt_ps(__m512(a)));
#endif
#if defined(__AVX__)
    if constexpr (sizeof a == 32 && doubles) return Vector(_mm256_sqrt_pd(__m256d(a)));
    if constexpr (sizeof a == 32 && !doubles) return Vector(_mm256_sqrt_ps(__m256(a)));
#endif
#if defined(__x86_64__)
    if constexpr (sizeof a == 16 && doubles) return Vector(_mm_sqrt_pd(__m128d(a)));
    if constexpr (sizeof a == 16 && !doubles) return Vector(_mm_sqrt_ps(__m128(a)));
#endif
    Vector r{};
    for (int i = 0; i < length_of<Vector>; ++i) r[i] = doubles ? __builtin_sqrt(a[i]) : __builtin_sqrtf(float(a[i]));
    return r;
  }
}

}  // namespace vectors
}  // namespace MURO_ISA
}  // namespace muro::lane
