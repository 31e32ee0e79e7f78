// SPDX-License-Identifier: MIT
// Numbers side by side: a Lane holds N values of T and calculates with all of them at once.
//
// A kernel is a template over its scalar S: `double`, or a Lane. Every operation of a lane rounds as the same operation
// of a double does, so both give the same bits. What decides between values is `select`, not `if`; an `if` over
// any(mask) may only leave out work whose result nobody selects.
//
// Kernel sources are compiled once for each instruction set (muro_add_kernels), with MURO_ISA naming it. They include
// these headers and nothing else that has inline functions of weight: the linker would keep one copy of such a
// function, perhaps one that the processor cannot run. For that reason all of this lies in a namespace of its own for
// each instruction set.
#pragma once

#include <cstdint>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#ifndef MURO_ISA
#define MURO_ISA base
#endif
#define MURO_INLINE [[gnu::always_inline]] inline

namespace muro::lane {
inline namespace MURO_ISA {

/// The compiler's vectors of N values of T and of the integers that their comparison gives.
template <class T, int N>
struct VectorOf;
template <>
struct VectorOf<double, 4> {
  typedef double Values __attribute__((vector_size(32)));
  typedef std::int64_t Truths __attribute__((vector_size(32)));
};
template <>
struct VectorOf<double, 8> {
  typedef double Values __attribute__((vector_size(64)));
  typedef std::int64_t Truths __attribute__((vector_size(64)));
};
template <>
struct VectorOf<float, 8> {
  typedef float Values __attribute__((vector_size(32)));
  typedef std::int32_t Truths __attribute__((vector_size(32)));
};
template <>
struct VectorOf<float, 16> {
  typedef float Values __attribute__((vector_size(64)));
  typedef std::int32_t Truths __attribute__((vector_size(64)));
};

/// Which of N values satisfy a condition.
template <class T, int N>
struct Mask {
  using Vector = typename VectorOf<T, N>::Truths;
  Vector v;

  MURO_INLINE Mask operator&(Mask b) const { return {v & b.v}; }
  MURO_INLINE Mask operator|(Mask b) const { return {v | b.v}; }
  MURO_INLINE Mask operator!() const { return {~v}; }
};

/// N values of T.
template <class T, int N>
struct Lane {
  using Vector = typename VectorOf<T, N>::Values;
  using M = Mask<T, N>;
  Vector v;

  Lane() = default;
  MURO_INLINE Lane(Vector x) : v(x) {}
  MURO_INLINE Lane(T x) : v(x - Vector{}) {}  // keeps the sign of a zero, as 0 + x would not

  MURO_INLINE T operator[](int i) const { return v[i]; }
  MURO_INLINE void set(int i, T x) { v[i] = x; }
  MURO_INLINE Lane operator-() const { return -v; }
  MURO_INLINE Lane& operator+=(Lane b) { return v += b.v, *this; }
  MURO_INLINE Lane& operator-=(Lane b) { return v -= b.v, *this; }
  MURO_INLINE Lane& operator*=(Lane b) { return v *= b.v, *this; }
  MURO_INLINE friend Lane operator+(Lane a, Lane b) { return a.v + b.v; }
  MURO_INLINE friend Lane operator-(Lane a, Lane b) { return a.v - b.v; }
  MURO_INLINE friend Lane operator*(Lane a, Lane b) { return a.v * b.v; }
  MURO_INLINE friend Lane operator/(Lane a, Lane b) { return a.v / b.v; }
  MURO_INLINE friend M operator<(Lane a, Lane b) { return {a.v < b.v}; }
  MURO_INLINE friend M operator<=(Lane a, Lane b) { return {a.v <= b.v}; }
  MURO_INLINE friend M operator>(Lane a, Lane b) { return {a.v > b.v}; }
  MURO_INLINE friend M operator>=(Lane a, Lane b) { return {a.v >= b.v}; }
  MURO_INLINE friend M operator==(Lane a, Lane b) { return {a.v == b.v}; }
};

using Double4 = Lane<double, 4>;
using Double8 = Lane<double, 8>;
using Float8 = Lane<float, 8>;
using Float16 = Lane<float, 16>;

/// How many values a scalar stands for, and its mask.
template <class S>
struct Traits {
  static constexpr int count = 1;
  using M = bool;
  using Value = S;
};
template <class T, int N>
struct Traits<Lane<T, N>> {
  static constexpr int count = N;
  using M = Mask<T, N>;
  using Value = T;
};
template <class S>
inline constexpr int count_of = Traits<S>::count;
template <class S>
using MaskOf = typename Traits<S>::M;

// --- choosing

MURO_INLINE double select(bool m, double a, double b) { return m ? a : b; }
MURO_INLINE float select(bool m, float a, float b) { return m ? a : b; }
template <class T, int N>
MURO_INLINE Lane<T, N> select(Mask<T, N> m, Lane<T, N> a, Lane<T, N> b) {
  return m.v ? a.v : b.v;
}
/// The lesser; `b` where they are equal or one is NaN.
template <class S>
MURO_INLINE S min(S a, S b) {
  return select(a < b, a, b);
}
/// The greater; `b` where they are equal or one is NaN.
template <class S>
MURO_INLINE S max(S a, S b) {
  return select(a > b, a, b);
}
template <class S>
MURO_INLINE S abs(S a) {
  return select(a < S(0), -a, a);
}

/// Bit i: whether value i satisfies the condition.
MURO_INLINE unsigned bits(bool m) { return m; }
template <class T, int N>
MURO_INLINE unsigned bits(Mask<T, N> m) {
#if defined(__AVX512DQ__)
  if constexpr (sizeof m.v == 64 && sizeof(T) == 8) return _mm512_movepi64_mask((__m512i)m.v);
  if constexpr (sizeof m.v == 64 && sizeof(T) == 4) return _mm512_movepi32_mask((__m512i)m.v);
#endif
#if defined(__AVX__)
  if constexpr (sizeof m.v == 32 && sizeof(T) == 8) return unsigned(_mm256_movemask_pd((__m256d)m.v));
  if constexpr (sizeof m.v == 32 && sizeof(T) == 4) return unsigned(_mm256_movemask_ps((__m256)m.v));
#endif
  unsigned all = 0;
  for (int i = 0; i < N; ++i) all |= unsigned(m.v[i] != 0) << i;
  return all;
}
template <class M>
MURO_INLINE bool any(M m) {
  return bits(m) != 0;
}

// --- functions

MURO_INLINE double sqrt(double a) { return __builtin_sqrt(a); }
MURO_INLINE float sqrt(float a) { return __builtin_sqrtf(a); }
template <class T, int N>
MURO_INLINE Lane<T, N> sqrt(Lane<T, N> a) {
#if defined(__AVX512F__)
  if constexpr (sizeof a.v == 64 && sizeof(T) == 8) return (typename Lane<T, N>::Vector)_mm512_sqrt_pd((__m512d)a.v);
  if constexpr (sizeof a.v == 64 && sizeof(T) == 4) return (typename Lane<T, N>::Vector)_mm512_sqrt_ps((__m512)a.v);
#endif
#if defined(__AVX__)
  if constexpr (sizeof a.v == 32 && sizeof(T) == 8) return (typename Lane<T, N>::Vector)_mm256_sqrt_pd((__m256d)a.v);
  if constexpr (sizeof a.v == 32 && sizeof(T) == 4) return (typename Lane<T, N>::Vector)_mm256_sqrt_ps((__m256)a.v);
#endif
  Lane<T, N> r;
  for (int i = 0; i < N; ++i) r.v[i] = sqrt(a.v[i]);
  return r;
}

// --- memory: one place a lane

/// Where each of the values of S has its data.
template <class S, class T = const double>
struct Places {
  T* at[count_of<S>];
};

/// Number `k` from each place.
template <class S>
MURO_INLINE S load(const Places<S>& from, int k) {
  if constexpr (count_of<S> == 1) {
    return from.at[0][k];
  } else {
    S r;
    for (int i = 0; i < count_of<S>; ++i) r.v[i] = from.at[i][k];
    return r;
  }
}
/// Number `k` to each place of the first `used` lanes.
template <class S>
MURO_INLINE void store(const Places<S, double>& to, int k, S value, int used = count_of<S>) {
  if constexpr (count_of<S> == 1) {
    to.at[0][k] = value;
  } else if (used == count_of<S>) {
    for (int i = 0; i < count_of<S>; ++i) to.at[i][k] = value.v[i];
  } else {
    for (int i = 0; i < used; ++i) to.at[i][k] = value.v[i];
  }
}

}  // namespace MURO_ISA
}  // namespace muro::lane
