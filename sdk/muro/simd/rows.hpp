// SPDX-License-Identifier: MIT
// Contiguous numbers of each place, such as those of a pose. They are read and written row by row and turned into lanes
// in registers, which is faster than number by number.
#pragma once

#include "muro/simd/geometry.hpp"

namespace muro::lane {
inline namespace MURO_ISA {

namespace detail {

/// Four places at once when registers hold as many doubles, otherwise two.
inline constexpr int group = vectors::register_bytes >= 32 ? 4 : 2;
using Two = typename vectors::VectorOf<double, 2>::Type;
using Group = typename vectors::VectorOf<double, group>::Type;
template <class S>
inline constexpr int groups_of = count_of<S> / group;
/// Whether values are handled in groups; true for Double4 and Double8.
template <class S>
inline constexpr bool has_groups = std::is_same_v<typename Traits<S>::Value, double> && (count_of<S> >= group);

MURO_INLINE Two load_two(const double* from) {
  Two v;
  __builtin_memcpy(&v, from, sizeof v);
  return v;
}
template <class Vector>
MURO_INLINE void store_at(double* to, const Vector& v) {
  __builtin_memcpy(to, &v, sizeof v);
}

/// Returns lanes g * group to g * group + group - 1.
template <int g, class Vector>
MURO_INLINE Group part(const Vector& v) {
  if constexpr (std::is_same_v<Vector, Group>) {
    return v;
  } else if constexpr (vectors::is_pair<Vector>) {
    constexpr int half = vectors::length_of<Vector> / (2 * group);  // in groups
    return part<g % half>(g < half ? v.low : v.high);
  } else {
    return __builtin_shufflevector(v, v, 4 * g, 4 * g + 1, 4 * g + 2, 4 * g + 3);
  }
}
template <class Vector, class Part>
MURO_INLINE Vector joined(const Part* parts) {
  if constexpr (std::is_same_v<Vector, Part>) {
    return parts[0];
  } else if constexpr (vectors::is_pair<Vector>) {
    using Half = decltype(Vector::low);
    return {joined<Half>(parts), joined<Half>(parts + vectors::length_of<Half> / group)};
  } else {
    return __builtin_shufflevector(parts[0], parts[1], 0, 1, 2, 3, 4, 5, 6, 7);
  }
}

#if MURO_HAS_MASK_REGISTERS
using Eight = typename vectors::VectorOf<double, 8>::Type;

/// Reads the first and the second number of each of eight places. Pairs are put into their quarters during the load.
MURO_INLINE void load_eight_pairs(const double* const* at, std::ptrdiff_t k, Eight& first, Eight& second) {
  const auto quarters = [&](const double* const* from) {
    __m512d v = _mm512_castpd128_pd512(_mm_loadu_pd(from[0] + k));
    v = _mm512_mask_broadcast_f64x2(v, 0x0c, _mm_loadu_pd(from[2] + k));
    v = _mm512_mask_broadcast_f64x2(v, 0x30, _mm_loadu_pd(from[4] + k));
    return _mm512_mask_broadcast_f64x2(v, 0xc0, _mm_loadu_pd(from[6] + k));
  };
  const __m512d even = quarters(at), odd = quarters(at + 1);
  first = Eight(_mm512_unpacklo_pd(even, odd));
  second = Eight(_mm512_unpackhi_pd(even, odd));
}
/// Reads the first four numbers of each of eight places.
MURO_INLINE void load_eight_fours(const double* const* at, std::ptrdiff_t k, Eight* to) {
  const auto halves = [&](const double* low, const double* high) {
    return _mm512_mask_broadcast_f64x4(_mm512_castpd256_pd512(_mm256_loadu_pd(low + k)), 0xf0,
                                       _mm256_loadu_pd(high + k));
  };
  const __m512d a = halves(at[0], at[2]), b = halves(at[1], at[3]), c = halves(at[4], at[6]), d = halves(at[5], at[7]);
  const __m512d even_ab = _mm512_unpacklo_pd(a, b), even_cd = _mm512_unpacklo_pd(c, d);
  const __m512d odd_ab = _mm512_unpackhi_pd(a, b), odd_cd = _mm512_unpackhi_pd(c, d);
  to[0] = Eight(_mm512_shuffle_f64x2(even_ab, even_cd, 0x88));
  to[1] = Eight(_mm512_shuffle_f64x2(odd_ab, odd_cd, 0x88));
  to[2] = Eight(_mm512_shuffle_f64x2(even_ab, even_cd, 0xdd));
  to[3] = Eight(_mm512_shuffle_f64x2(odd_ab, odd_cd, 0xdd));
}
/// Writes two numbers to each of eight places.
MURO_INLINE void store_eight_pairs(double* const* at, std::ptrdiff_t k, const Eight& first, const Eight& second) {
  const auto quarters = [&](double* const* to, __m512d v) {
    _mm_storeu_pd(to[0] + k, _mm512_castpd512_pd128(v));
    _mm_storeu_pd(to[2] + k, _mm512_extractf64x2_pd(v, 1));
    _mm_storeu_pd(to[4] + k, _mm512_extractf64x2_pd(v, 2));
    _mm_storeu_pd(to[6] + k, _mm512_extractf64x2_pd(v, 3));
  };
  quarters(at, _mm512_unpacklo_pd(__m512d(first), __m512d(second)));
  quarters(at + 1, _mm512_unpackhi_pd(__m512d(first), __m512d(second)));
}
/// Writes four numbers to each of eight places.
MURO_INLINE void store_eight_fours(double* const* at, std::ptrdiff_t k, const Eight& a, const Eight& b, const Eight& c,
                                   const Eight& d) {
  const auto halves = [&](double* const* to, __m512d first, __m512d last) {
    const __m512d low = _mm512_permutex2var_pd(first, _mm512_setr_epi64(0, 1, 8, 9, 2, 3, 10, 11), last);
    const __m512d high = _mm512_permutex2var_pd(first, _mm512_setr_epi64(4, 5, 12, 13, 6, 7, 14, 15), last);
    _mm256_storeu_pd(to[0] + k, _mm512_castpd512_pd256(low));
    _mm256_storeu_pd(to[2] + k, _mm512_extractf64x4_pd(low, 1));
    _mm256_storeu_pd(to[4] + k, _mm512_castpd512_pd256(high));
    _mm256_storeu_pd(to[6] + k, _mm512_extractf64x4_pd(high, 1));
  };
  halves(at, _mm512_unpacklo_pd(__m512d(a), __m512d(b)), _mm512_unpacklo_pd(__m512d(c), __m512d(d)));
  halves(at + 1, _mm512_unpackhi_pd(__m512d(a), __m512d(b)), _mm512_unpackhi_pd(__m512d(c), __m512d(d)));
}
/// Reads numbers k to n - 1 of each of eight places.
template <int k, int n, class S>
MURO_INLINE void load_eight_from(const Places<S>& from, std::ptrdiff_t first, S (&to)[n]) {
  if constexpr (n - k >= 4) {
    Eight four[4];
    load_eight_fours(from.at, first + k, four);
    for (int i = 0; i < 4; ++i) to[k + i].v = four[i];
    load_eight_from<k + 4, n, S>(from, first, to);
  } else if constexpr (n - k == 3 && n > 3) {  // one number twice is faster than two pieces
    Eight four[4];
    load_eight_fours(from.at, first + k - 1, four);
    for (int i = 1; i < 4; ++i) to[k - 1 + i].v = four[i];
  } else if constexpr (n - k >= 2) {
    load_eight_pairs(from.at, first + k, to[k].v, to[k + 1].v);
    load_eight_from<k + 2, n, S>(from, first, to);
  } else if constexpr (n - k == 1) {
    to[k] = load<S>(from, first + k);
  }
}
template <int k, int n, class S>
MURO_INLINE void store_eight_from(const Places<S, double>& to, std::ptrdiff_t first, const S (&from)[n]) {
  constexpr int left = n - k, at = left == 3 && n > 3 ? k - 1 : k;  // one number twice is faster than two pieces
  if constexpr (n - at >= 4) {
    store_eight_fours(to.at, first + at, from[at].v, from[at + 1].v, from[at + 2].v, from[at + 3].v);
    store_eight_from<at + 4, n, S>(to, first, from);
  } else if constexpr (left >= 2) {
    store_eight_pairs(to.at, first + k, from[k].v, from[k + 1].v);
    store_eight_from<k + 2, n, S>(to, first, from);
  } else if constexpr (left == 1) {
    for (int i = 0; i < 8; ++i) to.at[i][first + k] = from[k][i];
  }
}
#endif

/// Reads the first and the second number of each place of a group.
MURO_INLINE void load_pairs(const double* const* at, std::ptrdiff_t k, Group& first, Group& second) {
#if defined(__AVX__)
  const Group even = __builtin_shufflevector(load_two(at[0] + k), load_two(at[2] + k), 0, 1, 2, 3);
  const Group odd = __builtin_shufflevector(load_two(at[1] + k), load_two(at[3] + k), 0, 1, 2, 3);
  first = __builtin_shufflevector(even, odd, 0, 4, 2, 6);
  second = __builtin_shufflevector(even, odd, 1, 5, 3, 7);
#else
  const Group even = load_two(at[0] + k), odd = load_two(at[1] + k);
  first = __builtin_shufflevector(even, odd, 0, 2);
  second = __builtin_shufflevector(even, odd, 1, 3);
#endif
}
MURO_INLINE void store_pairs(double* const* at, std::ptrdiff_t k, const Group& first, const Group& second,
                             unsigned which) {
#if defined(__AVX__)
  const Group even = __builtin_shufflevector(first, second, 0, 4, 2, 6);
  const Group odd = __builtin_shufflevector(first, second, 1, 5, 3, 7);
  if (which & 1) store_at(at[0] + k, Two(__builtin_shufflevector(even, even, 0, 1)));
  if (which & 2) store_at(at[1] + k, Two(__builtin_shufflevector(odd, odd, 0, 1)));
  if (which & 4) store_at(at[2] + k, Two(__builtin_shufflevector(even, even, 2, 3)));
  if (which & 8) store_at(at[3] + k, Two(__builtin_shufflevector(odd, odd, 2, 3)));
#else
  if (which & 1) store_at(at[0] + k, Group(__builtin_shufflevector(first, second, 0, 2)));
  if (which & 2) store_at(at[1] + k, Group(__builtin_shufflevector(first, second, 1, 3)));
#endif
}
/// Writes four numbers to each place of a group.
MURO_INLINE void store_fours(double* const* at, std::ptrdiff_t k, const Group (&v)[4], unsigned which) {
#if defined(__AVX__)
  const Group even01 = __builtin_shufflevector(v[0], v[1], 0, 4, 2, 6);
  const Group odd01 = __builtin_shufflevector(v[0], v[1], 1, 5, 3, 7);
  const Group even23 = __builtin_shufflevector(v[2], v[3], 0, 4, 2, 6);
  const Group odd23 = __builtin_shufflevector(v[2], v[3], 1, 5, 3, 7);
  if (which & 1) store_at(at[0] + k, Group(__builtin_shufflevector(even01, even23, 0, 1, 4, 5)));
  if (which & 2) store_at(at[1] + k, Group(__builtin_shufflevector(odd01, odd23, 0, 1, 4, 5)));
  if (which & 4) store_at(at[2] + k, Group(__builtin_shufflevector(even01, even23, 2, 3, 6, 7)));
  if (which & 8) store_at(at[3] + k, Group(__builtin_shufflevector(odd01, odd23, 2, 3, 6, 7)));
#else
  store_pairs(at, k, v[0], v[1], which);
  store_pairs(at, k + 2, v[2], v[3], which);
#endif
}

/// Writes numbers k to n - 1 of the places of group g.
template <int k, int n, int g, class S>
MURO_INLINE void store_from(const Places<S, double>& to, std::ptrdiff_t first, const S (&from)[n], unsigned which) {
  constexpr int left = n - k, at = left == 3 && n > 3 ? k - 1 : k;  // one number twice is faster than two pieces
  double* const* const places = to.at + g * group;
  const unsigned mine = which >> g * group;
  if constexpr (n - at >= 4) {
    store_fours(places, first + at,
                {part<g>(from[at].v), part<g>(from[at + 1].v), part<g>(from[at + 2].v), part<g>(from[at + 3].v)}, mine);
    store_from<at + 4, n, g, S>(to, first, from, which);
  } else if constexpr (left >= 2) {
    store_pairs(places, first + k, part<g>(from[k].v), part<g>(from[k + 1].v), mine);
    store_from<k + 2, n, g, S>(to, first, from, which);
  } else if constexpr (left == 1) {
    const Group last = part<g>(from[k].v);
    for (int i = 0; i < group; ++i)
      if (mine >> i & 1) places[i][first + k] = last[i];
  }
}
template <int n, class S, int... groups>
MURO_INLINE void store_groups(const Places<S, double>& to, std::ptrdiff_t first, const S (&from)[n], unsigned which,
                              std::integer_sequence<int, groups...>) {
  (store_from<0, n, groups, S>(to, first, from, which), ...);
}

}  // namespace detail

/// Reads contiguous numbers in the order of the values of S.
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

/// Reads numbers `first` to `first` + n - 1 of each place.
template <int n, class S>
MURO_INLINE void load_rows(const Places<S>& from, std::ptrdiff_t first, S (&to)[n]) {
  if constexpr (detail::has_groups<S>) {
#if MURO_HAS_MASK_REGISTERS
    if constexpr (count_of<S> == 8) return detail::load_eight_from<0, n, S>(from, first, to);
#endif
    for (int k = 0; k + 1 < n; k += 2) {
      constexpr int groups = detail::groups_of<S>;
      detail::Group a[groups], b[groups];
      for (int g = 0; g < groups; ++g) detail::load_pairs(from.at + g * detail::group, first + k, a[g], b[g]);
      to[k] = detail::joined<typename S::Vector>(a);
      to[k + 1] = detail::joined<typename S::Vector>(b);
    }
    if constexpr (n % 2 == 1) to[n - 1] = load<S>(from, first + n - 1);
  } else {
    for (int k = 0; k < n; ++k) to[k] = load<S>(from, first + k);
  }
}

/// Returns a bit for each of the first `used` lanes.
constexpr unsigned first_lanes(int used) { return (1u << used) - 1; }
template <class S>
inline constexpr unsigned all_lanes = first_lanes(count_of<S>);

/// Writes n numbers of each place, from number `first` on, for the lanes whose bit is set in `which`.
template <int n, class S>
MURO_INLINE void store_rows(const Places<S, double>& to, std::ptrdiff_t first, const S (&from)[n],
                            unsigned which = all_lanes<S>) {
  if constexpr (detail::has_groups<S>) {
    constexpr std::make_integer_sequence<int, detail::groups_of<S>> groups;
#if MURO_HAS_MASK_REGISTERS
    if constexpr (count_of<S> == 8)
      if (which == all_lanes<S>) return detail::store_eight_from<0, n, S>(to, first, from);
#endif
    if (which == all_lanes<S>)  // without a check for each place
      detail::store_groups<n, S>(to, first, from, all_lanes<S>, groups);
    else
      detail::store_groups<n, S>(to, first, from, which, groups);
  } else {
    for (int k = 0; k < n; ++k)
      for (int i = 0; i < count_of<S>; ++i)
        if (which >> i & 1) {
          if constexpr (count_of<S> == 1)
            to.at[i][first + k] = from[k];
          else
            to.at[i][first + k] = from[k][i];
        }
  }
}

// --- values of properties (muro/geometry.hpp), from number `first` on of each place

template <class S>
MURO_INLINE V3<S> load_vector(const Places<S>& from, std::ptrdiff_t first = 0) {
  S v[3];
  load_rows(from, first, v);
  return {v[0], v[1], v[2]};
}
template <class S>
MURO_INLINE PoseOf<S> load_pose(const Places<S>& from, std::ptrdiff_t first = 0) {
  S v[7];
  load_rows(from, first, v);
  return {{v[0], v[1], v[2]}, {v[3], v[4], v[5], v[6]}};
}
template <class S>
MURO_INLINE TwistOf<S> load_twist(const Places<S>& from, std::ptrdiff_t first = 0) {
  S v[6];
  load_rows(from, first, v);
  return {{v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
}
template <class S>
MURO_INLINE void store_vector(const Places<S, double>& to, std::ptrdiff_t first, const V3<S>& v,
                              unsigned which = all_lanes<S>) {
  store_rows(to, first, {v.x, v.y, v.z}, which);
}
template <class S>
MURO_INLINE void store_pose(const Places<S, double>& to, std::ptrdiff_t first, const PoseOf<S>& pose,
                            unsigned which = all_lanes<S>) {
  const V3<S>& p = pose.position;
  const Q4<S>& q = pose.orientation;
  store_rows(to, first, {p.x, p.y, p.z, q.x, q.y, q.z, q.w}, which);
}
template <class S>
MURO_INLINE void store_twist(const Places<S, double>& to, std::ptrdiff_t first, const TwistOf<S>& twist,
                             unsigned which = all_lanes<S>) {
  const V3<S>&v = twist.linear, &w = twist.angular;
  store_rows(to, first, {v.x, v.y, v.z, w.x, w.y, w.z}, which);
}

}  // namespace MURO_ISA
}  // namespace muro::lane
