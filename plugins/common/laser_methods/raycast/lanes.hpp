// SPDX-License-Identifier: MIT
// Sixteen floats, or as many doubles in two lanes.
#pragma once

#include "muro/simd/geometry.hpp"

namespace muro::raycast::rays {
inline namespace MURO_ISA {

using D = lane::Double8;
using F = lane::Float16;

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

}  // namespace detail

/// Numbers that lie one behind the other.
template <class S>
MURO_INLINE S load(const typename lane::Traits<S>::Value* from) {
  return detail::load_at<typename S::Vector>(from);
}
template <class S>
MURO_INLINE void store(typename lane::Traits<S>::Value* to, S value) {
  detail::store_at<typename S::Vector>(to, value.v);
}

/// Rounded to floats.
MURO_INLINE F narrow(D first, D second) { return detail::narrowed<F::Vector>(first.v, second.v); }

/// Bit i: the sign of value i; set for a negative one.
MURO_INLINE unsigned signs(F a) { return detail::bits_of(detail::sign_bits(a.v)); }
inline constexpr unsigned all_signs = 0xffff;

}  // namespace MURO_ISA
}  // namespace muro::raycast::rays
