// SPDX-License-Identifier: MIT
// Spatial algebra (Featherstone, Rigid Body Dynamics Algorithms, 2008, chapter 2) over any scalar of muro/simd:
// inertias in blocks, and their rotation about one axis of a frame. The compiler knows the indices, so that all values
// stay in registers.
#pragma once

#include "plugins/common/lanes/turn.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

using lane::cross, lane::dot, lane::Turn, lane::turn_by, lane::V3;

/// Returns component I of three that follow each other in a circle.
template <int I, class T>
MURO_INLINE T& pick(T& x, T& y, T& z) {
  if constexpr (I % 3 == 0)
    return x;
  else if constexpr (I % 3 == 1)
    return y;
  else
    return z;
}
template <int I, class V>
MURO_INLINE auto& at(V& v) {
  return pick<I>(v.x, v.y, v.z);
}

/// A symmetric matrix.
template <class S>
struct Sym {
  S xx, yy, zz, yz, zx, xy;

  MURO_INLINE friend V3<S> operator*(const Sym& s, const V3<S>& v) {
    return {s.xx * v.x + s.xy * v.y + s.zx * v.z, s.xy * v.x + s.yy * v.y + s.yz * v.z,
            s.zx * v.x + s.yz * v.y + s.zz * v.z};
  }
};
template <int I, class M>
MURO_INLINE auto& diagonal(M& m) {
  return pick<I>(m.xx, m.yy, m.zz);
}
/// Returns the entry of the two other axes.
template <int I, class M>
MURO_INLINE auto& opposite(M& m) {
  return pick<I>(m.yz, m.zx, m.xy);
}

/// A matrix by its rows.
template <class S>
struct Rows {
  V3<S> x, y, z;
};
template <int I, int J, class M>
MURO_INLINE auto& entry(M& m) {
  return at<J>(at<I>(m));
}

/// A spatial inertia [A B; B' C]: moment = A alpha + B a, force = B' alpha + C a; and the wrench (moment n, force f)
/// that is needed beyond that of acceleration.
template <class S>
struct Inertia {
  Sym<S> A;
  Rows<S> B;
  Sym<S> C;
  V3<S> n, f;

  static constexpr int numbers = 27;
  MURO_INLINE Inertia& operator+=(const Inertia& other) {
    S* to = &A.xx;
    const S* from = &other.A.xx;
#pragma GCC unroll 27
    for (int i = 0; i < numbers; ++i) to[i] += from[i];
    return *this;
  }
};
static_assert(sizeof(Inertia<double>) == Inertia<double>::numbers * sizeof(double));

/// Changes a vector from a frame into one that is turned about its axis K.
template <int K, class S>
MURO_INLINE V3<S> into(const Turn<S>& t, const V3<S>& v) {
  V3<S> o = v;
  at<K + 1>(o) = t.c * at<K + 1>(v) + t.s * at<K + 2>(v);
  at<K + 2>(o) = t.c * at<K + 2>(v) - t.s * at<K + 1>(v);
  return o;
}
/// Changes a vector back out of that frame.
template <int K, class S>
MURO_INLINE V3<S> out_of(const Turn<S>& t, const V3<S>& v) {
  return into<K>(Turn<S>{t.c, -t.s}, v);
}
/// Returns R M R' for the rotation about axis K, with 10 products instead of 54.
template <int K, class S>
MURO_INLINE Sym<S> out_of(const Turn<S>& t, const Sym<S>& m) {
  constexpr int I = K + 1, J = K + 2;
  const S c = t.c, s = t.s;
  Sym<S> o = m;
  const S d = diagonal<J>(m) - diagonal<I>(m), e = opposite<K>(m) + opposite<K>(m), w = s * (s * d - c * e);
  diagonal<I>(o) = diagonal<I>(m) + w;
  diagonal<J>(o) = diagonal<J>(m) - w;
  opposite<K>(o) = opposite<K>(m) - s * (c * d + s * e);
  opposite<J>(o) = c * opposite<J>(m) - s * opposite<I>(m);
  opposite<I>(o) = s * opposite<J>(m) + c * opposite<I>(m);
  return o;
}
template <int K, class S>
MURO_INLINE Rows<S> out_of(const Turn<S>& t, const Rows<S>& m) {
  constexpr int I = K + 1, J = K + 2;
  const S c = t.c, s = t.s;
  Rows<S> o = m;
  const S d = entry<J, J>(m) - entry<I, I>(m), e = entry<I, J>(m) + entry<J, I>(m), w = s * (s * d - c * e);
  const S u = s * (c * d + s * e);
  entry<I, I>(o) = entry<I, I>(m) + w;
  entry<J, J>(o) = entry<J, J>(m) - w;
  entry<I, J>(o) = entry<I, J>(m) - u;
  entry<J, I>(o) = entry<J, I>(m) - u;
  entry<I, K>(o) = c * entry<I, K>(m) - s * entry<J, K>(m);
  entry<J, K>(o) = s * entry<I, K>(m) + c * entry<J, K>(m);
  entry<K, I>(o) = c * entry<K, I>(m) - s * entry<K, J>(m);
  entry<K, J>(o) = s * entry<K, I>(m) + c * entry<K, J>(m);
  return o;
}
template <int K, class S>
MURO_INLINE Inertia<S> out_of(const Turn<S>& t, const Inertia<S>& m) {
  return {out_of<K>(t, m.A), out_of<K>(t, m.B), out_of<K>(t, m.C), out_of<K>(t, m.n), out_of<K>(t, m.f)};
}

/// Changes out of and into a frame by a constant rotation, given by its columns.
template <class S>
MURO_INLINE V3<S> out_of(const lane::M3<S>& r, const V3<S>& v) {
  return r * v;
}
template <class S>
MURO_INLINE V3<S> into(const lane::M3<S>& r, const V3<S>& v) {
  return transposed_times(r, v);
}
/// R M R', by rows.
template <class S>
MURO_INLINE Rows<S> out_of(const lane::M3<S>& r, const Rows<S>& m) {
  const V3<S> x = r * m.x, y = r * m.y, z = r * m.z;  // rows of M R'
  return {x * r.x.x + y * r.y.x + z * r.z.x, x * r.x.y + y * r.y.y + z * r.z.y, x * r.x.z + y * r.y.z + z * r.z.z};
}
template <class S>
MURO_INLINE Sym<S> out_of(const lane::M3<S>& r, const Sym<S>& m) {
  const Rows<S> o = out_of(r, Rows<S>{{m.xx, m.xy, m.zx}, {m.xy, m.yy, m.yz}, {m.zx, m.yz, m.zz}});
  return {o.x.x, o.y.y, o.z.z, o.y.z, o.x.z, o.x.y};
}
template <class S>
MURO_INLINE Inertia<S> out_of(const lane::M3<S>& r, const Inertia<S>& m) {
  return {out_of(r, m.A), out_of(r, m.B), out_of(r, m.C), out_of(r, m.n), out_of(r, m.f)};
}

/// Moves the inertia to a new origin, from which the old one is at `r`: B' = B + r C, A' = A + r B^T - B' r, with r the
/// matrix of its cross product.
template <class S>
MURO_INLINE void shift(Inertia<S>& m, const V3<S>& r) {
  const Rows<S> b = m.B;
  const Sym<S>& C = m.C;
  m.B.x.x += r.y * C.zx - r.z * C.xy, m.B.x.y += r.y * C.yz - r.z * C.yy, m.B.x.z += r.y * C.zz - r.z * C.yz;
  m.B.y.x += r.z * C.xx - r.x * C.zx, m.B.y.y += r.z * C.xy - r.x * C.yz, m.B.y.z += r.z * C.zx - r.x * C.zz;
  m.B.z.x += r.x * C.xy - r.y * C.xx, m.B.z.y += r.x * C.yy - r.y * C.xy, m.B.z.z += r.x * C.yz - r.y * C.zx;
  const Rows<S>& e = m.B;
  m.A.xx += (r.y * b.x.z - r.z * b.x.y) - (e.x.y * r.z - e.x.z * r.y);
  m.A.yy += (r.z * b.y.x - r.x * b.y.z) - (e.y.z * r.x - e.y.x * r.z);
  m.A.zz += (r.x * b.z.y - r.y * b.z.x) - (e.z.x * r.y - e.z.y * r.x);
  m.A.xy += (r.y * b.y.z - r.z * b.y.y) - (e.x.z * r.x - e.x.x * r.z);
  m.A.zx += (r.y * b.z.z - r.z * b.z.y) - (e.x.x * r.y - e.x.y * r.x);
  m.A.yz += (r.z * b.z.x - r.x * b.z.z) - (e.y.x * r.y - e.y.y * r.x);
  m.n += cross(r, m.f);
}

template <class S>
MURO_INLINE Sym<S> inverse(const Sym<S>& s) {
  const Sym<S> o{s.yy * s.zz - s.yz * s.yz, s.xx * s.zz - s.zx * s.zx, s.xx * s.yy - s.xy * s.xy,
                 s.zx * s.xy - s.xx * s.yz, s.xy * s.yz - s.yy * s.zx, s.yz * s.zx - s.zz * s.xy};
  const S d = S(1) / (s.xx * o.xx + s.xy * o.xy + s.zx * o.zx);
  return {o.xx * d, o.yy * d, o.zz * d, o.yz * d, o.zx * d, o.xy * d};
}

/// Finds alpha and a of [A B; B' C] (alpha, a) = (moment, force), by the Schur complement of C.
template <class S>
MURO_INLINE void solve(const Inertia<S>& m, const V3<S>& moment, const V3<S>& force, V3<S>& alpha, V3<S>& a) {
  const Sym<S> i = inverse(m.C);
  const V3<S> x = i * m.B.x, y = i * m.B.y, z = i * m.B.z;  // rows of B inverse(C)
  const Sym<S> s{m.A.xx - dot(x, m.B.x), m.A.yy - dot(y, m.B.y), m.A.zz - dot(z, m.B.z),
                 m.A.yz - dot(y, m.B.z), m.A.zx - dot(z, m.B.x), m.A.xy - dot(x, m.B.y)};
  alpha = inverse(s) * V3<S>{moment.x - dot(x, force), moment.y - dot(y, force), moment.z - dot(z, force)};
  a = i * (force - (m.B.x * alpha.x + m.B.y * alpha.y + m.B.z * alpha.z));
}

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
