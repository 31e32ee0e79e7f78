// SPDX-License-Identifier: MIT
// Lanes of numbers: a Lane holds N values of T and calculates with all of them at once.
//
// A kernel is a template over its scalar S: `double`, or a Lane. Every operation of a lane rounds like the same
// operation of a double, so both give the same bits. `select` chooses between values, not `if`. An `if` over any(mask)
// may only leave out work whose result is never selected.
//
// Kernel sources are compiled once for each instruction set (muro_add_kernels), with MURO_ISA as its name. They include
// these headers and no others with large inline functions: the linker would keep one copy of such a function, perhaps
// one that the processor cannot run. For that reason these headers have a namespace of their own for each instruction
// set.
#pragma once

#include "muro/simd/vector.hpp"

namespace muro::lane {
inline namespace MURO_ISA {

/// The result of a condition for each of N values.
#if MURO_HAS_MASK_REGISTERS
template <class T, int N>
struct Mask {
  using Bits = std::conditional_t<(N > 8), __mmask16, __mmask8>;
  static constexpr unsigned all = (1u << N) - 1;
  Bits v;

  MURO_INLINE Mask operator&(Mask b) const { return {Bits(v & b.v)}; }
  MURO_INLINE Mask operator|(Mask b) const { return {Bits(v | b.v)}; }
  MURO_INLINE Mask operator!() const { return {Bits(~v & all)}; }
};
#else
template <class T, int N>
struct Mask {
  using Vector = decltype(std::declval<typename vectors::VectorOf<T, N>::Type>() <
                          std::declval<typename vectors::VectorOf<T, N>::Type>());
  Vector v;

  MURO_INLINE Mask operator&(Mask b) const { return {v & b.v}; }
  MURO_INLINE Mask operator|(Mask b) const { return {v | b.v}; }
  MURO_INLINE Mask operator!() const { return {~v}; }
};
#endif

/// N values of T.
template <class T, int N>
struct Lane {
  using Vector = typename vectors::VectorOf<T, N>::Type;
  using M = Mask<T, N>;
  Vector v;

  Lane() = default;
  MURO_INLINE Lane(Vector x) : v(x) {}
  MURO_INLINE Lane(T x) : v(vectors::splat<Vector>(x)) {}

  MURO_INLINE T operator[](int i) const { return vectors::get(v, i); }
  MURO_INLINE void set(int i, T x) { vectors::set(v, i, x); }
  MURO_INLINE Lane operator-() const { return -v; }
  MURO_INLINE Lane& operator+=(Lane b) { return v = v + b.v, *this; }
  MURO_INLINE Lane& operator-=(Lane b) { return v = v - b.v, *this; }
  MURO_INLINE Lane& operator*=(Lane b) { return v = v * b.v, *this; }
  MURO_INLINE friend Lane operator+(Lane a, Lane b) { return a.v + b.v; }
  MURO_INLINE friend Lane operator-(Lane a, Lane b) { return a.v - b.v; }
  MURO_INLINE friend Lane operator*(Lane a, Lane b) { return a.v * b.v; }
  MURO_INLINE friend Lane operator/(Lane a, Lane b) { return a.v / b.v; }
#if MURO_HAS_MASK_REGISTERS
  using Comparison = vectors::Comparison;
  template <Comparison c>
  MURO_INLINE static M compare(Lane a, Lane b) {
    return {typename M::Bits(vectors::compare<c>(a.v, b.v))};
  }
  MURO_INLINE friend M operator<(Lane a, Lane b) { return compare<Comparison::less>(a, b); }
  MURO_INLINE friend M operator<=(Lane a, Lane b) { return compare<Comparison::less_or_equal>(a, b); }
  MURO_INLINE friend M operator>(Lane a, Lane b) { return compare<Comparison::greater>(a, b); }
  MURO_INLINE friend M operator>=(Lane a, Lane b) { return compare<Comparison::greater_or_equal>(a, b); }
  MURO_INLINE friend M operator==(Lane a, Lane b) { return compare<Comparison::equal>(a, b); }
#else
  MURO_INLINE friend M operator<(Lane a, Lane b) { return {a.v < b.v}; }
  MURO_INLINE friend M operator<=(Lane a, Lane b) { return {a.v <= b.v}; }
  MURO_INLINE friend M operator>(Lane a, Lane b) { return {a.v > b.v}; }
  MURO_INLINE friend M operator>=(Lane a, Lane b) { return {a.v >= b.v}; }
  MURO_INLINE friend M operator==(Lane a, Lane b) { return {a.v == b.v}; }
#endif
};

using Double4 = Lane<double, 4>;
using Double8 = Lane<double, 8>;
using Float8 = Lane<float, 8>;
using Float16 = Lane<float, 16>;

/// The number of values in a scalar, and its mask.
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

/// Serves `count` robots, at most 8, in one lane or one after the other, whichever takes less time. It calls `unsigned
/// part.operator()<S>(int first, int used)` for `used` robots from number `first` on. `part` returns bits, the lowest
/// for its first robot; the bits of all robots are returned.
template <class Part>
MURO_INLINE unsigned in_lanes(int count, const Part& part) {
  constexpr int worth_a_lane = vectors::register_bytes >= 32 ? 2 : 3;
  if (count > 4) return part.template operator()<Double8>(0, count);
  if (count >= worth_a_lane) return part.template operator()<Double4>(0, count);
  unsigned all = 0;
  for (int i = 0; i < count; ++i) all |= part.template operator()<double>(i, 1) << i;
  return all;
}

// --- choosing

MURO_INLINE double select(bool m, double a, double b) { return m ? a : b; }
MURO_INLINE float select(bool m, float a, float b) { return m ? a : b; }
template <class T, int N>
MURO_INLINE Lane<T, N> select(Mask<T, N> m, Lane<T, N> a, Lane<T, N> b) {
#if MURO_HAS_MASK_REGISTERS
  return vectors::choose_by_bits(m.v, a.v, b.v);
#else
  return vectors::choose(m.v, a.v, b.v);
#endif
}
/// The lesser value; `b` when they are equal or one is NaN.
template <class S>
MURO_INLINE S min(S a, S b) {
#if MURO_HAS_MASK_REGISTERS
  if constexpr (count_of < S >> 1) return vectors::lesser(a.v, b.v);
#endif
  return select(a < b, a, b);
}
/// The greater value; `b` when they are equal or one is NaN.
template <class S>
MURO_INLINE S max(S a, S b) {
#if MURO_HAS_MASK_REGISTERS
  if constexpr (count_of < S >> 1) return vectors::greater(a.v, b.v);
#endif
  return select(a > b, a, b);
}
MURO_INLINE double abs(double a) { return __builtin_fabs(a); }
MURO_INLINE float abs(float a) { return __builtin_fabsf(a); }
template <class T, int N>
MURO_INLINE Lane<T, N> abs(Lane<T, N> a) {
  return vectors::magnitude(a.v);
}

/// Bit i of the result: whether value i satisfies the condition.
MURO_INLINE unsigned bits(bool m) { return m; }
template <class T, int N>
MURO_INLINE unsigned bits(Mask<T, N> m) {
#if MURO_HAS_MASK_REGISTERS
  return m.v;
#else
  return vectors::bits_of(m.v);
#endif
}
/// Returns the mask of the values whose bits are set.
template <class S>
MURO_INLINE MaskOf<S> mask_of(unsigned set) {
  if constexpr (count_of<S> == 1) {
    return (set & 1) != 0;
  } else {
#if MURO_HAS_MASK_REGISTERS
    return {typename MaskOf<S>::Bits(set)};
#else
    using Bits = typename MaskOf<S>::Vector;
    using Whole = vectors::Element<Bits>;
    alignas(64) static constexpr Whole bit_of[] = {1,       1 << 1,  1 << 2,  1 << 3, 1 << 4,  1 << 5,
                                                   1 << 6,  1 << 7,  1 << 8,  1 << 9, 1 << 10, 1 << 11,
                                                   1 << 12, 1 << 13, 1 << 14, 1 << 15};
    Bits bit;
    __builtin_memcpy(&bit, bit_of, sizeof bit);
    return {(vectors::splat<Bits>(Whole(set)) & bit) == bit};
#endif
  }
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
  return vectors::root(a.v);
}

// --- memory: one place for each lane

/// Addresses of the data of each value of S.
template <class S, class T = const double>
struct Places {
  T* at[count_of<S>];
};

template <class S>
MURO_INLINE Places<S> as_read(const Places<S, double>& places) {
  Places<S> p;
  for (int i = 0; i < count_of<S>; ++i) p.at[i] = places.at[i];
  return p;
}

/// Reads number `k` of each place.
template <class S>
MURO_INLINE S load(const Places<S>& from, std::ptrdiff_t k) {
  if constexpr (count_of<S> == 1) {
    return from.at[0][k];
  } else {
    return vectors::gather<typename S::Vector>(from.at, k);
  }
}
/// Writes number `k` of each place of the first `used` lanes.
template <class S>
MURO_INLINE void store(const Places<S, double>& to, std::ptrdiff_t k, S value, int used = count_of<S>) {
  if constexpr (count_of<S> == 1) {
    to.at[0][k] = value;
  } else if (used == count_of<S>) {
    for (int i = 0; i < count_of<S>; ++i) to.at[i][k] = value[i];
  } else {
    for (int i = 0; i < used; ++i) to.at[i][k] = value[i];
  }
}

}  // namespace MURO_ISA
}  // namespace muro::lane
