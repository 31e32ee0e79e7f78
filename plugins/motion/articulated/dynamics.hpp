// SPDX-License-Identifier: MIT
// The passes of the articulated-body algorithm (Featherstone, table 7.1) over any scalar of muro/simd, with joints that
// are driven by efforts and joints that are held (hybrid dynamics, section 9.2). Velocities and accelerations are
// spatial, in the frame of each body, at its origin; accelerations are those beyond gravity.
#pragma once

#include "muro/simd/rows.hpp"
#include "muro/simd/trig.hpp"
#include "spatial.hpp"
#include "structure.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

using lane::M3, lane::splat, lane::V3;

/// How a joint moves in a step: qdd = rate + is_free (effort - what the bodies behind it need) / inertia. One per
/// joint.
template <class S>
struct JointTerms {
  S effort;   ///< N m or N
  S inertia;  ///< kg m^2 or kg, beside that of the bodies: armature, and what drives and dampers do implicitly
  S rate;     ///< rad/s^2 or m/s^2: of a held joint, else 0
  S is_free;  ///< 1, or 0: held
};

/// What a step keeps of each body and its joint.
template <class S>
struct BodyStep {
  Turn<S> turn;    ///< of a hinge
  S q, qd;         ///< rad or m, rad/s or m/s, in the direction of the body's axis
  V3<S> w, v;      ///< angular and linear velocity
  V3<S> Un, Uf;    ///< inertia times the joint's direction
  S D;             ///< inertia that the joint moves, with its own terms
  S give;          ///< how the joint gives way: 1 / D, or 0 where it is held
  S bias;          ///< effort that it lacks when it does not accelerate
  S needed;        ///< the same with the acceleration of its parent
  S qdd;           ///< acceleration of the joint
  V3<S> alpha, a;  ///< acceleration
  M3<S> axes;      ///< of the frame in the world
  V3<S> origin;    ///< m, in the world
  JointTerms<S> terms;
};

/// Masses of as many robots as S has values: each has its own, or all have the same.
template <class S>
struct Masses {
  lane::Places<S> at;  ///< Mass of body 0
  bool are_equal = true;

  MURO_INLINE void load(int body, S (&to)[Mass::numbers]) const {
    const std::ptrdiff_t first = std::ptrdiff_t(body) * Mass::numbers;
    if (are_equal)
      for (int k = 0; k < Mass::numbers; ++k) to[k] = S(at.at[0][first + k]);
    else
      lane::load_rows(at, first, to);
  }
};

/// (w x e_K) s, and the like: two components.
template <int K, class S>
MURO_INLINE void add_across(V3<S>& to, const V3<S>& v, S s) {
  at<K + 1>(to) += at<K + 2>(v) * s;
  at<K + 2>(to) -= at<K + 1>(v) * s;
}

template <class S>
MURO_INLINE V3<S> offset_of(const Body& b, S q) {
  V3<S> o = splat<S>(b.offset);
  if (b.slides) o += splat<S>(b.turn + 3 * b.axis) * q;
  return o;
}
template <class S>
MURO_INLINE M3<S> turn_of(const Body& b) {
  return {splat<S>(b.turn), splat<S>(b.turn + 3), splat<S>(b.turn + 6)};
}

/// A spatial vector (angular w, linear v) of the parent in the frame of a body.
template <int K, class S>
MURO_INLINE void into_body(const Body& b, const BodyStep<S>& own, V3<S>& w, V3<S>& v) {
  if (b.shifted || b.slides) v += cross(w, offset_of(b, own.q));
  if (b.turned) w = into(turn_of<S>(b), w), v = into(turn_of<S>(b), v);
  if (!b.slides) w = into<K>(own.turn, w), v = into<K>(own.turn, v);
}

/// Velocity and pose of a body from those of its parent.
template <int K, class S>
[[gnu::noinline]] void place(const Body& b, BodyStep<S>* bodies, int i) {
  BodyStep<S>& own = bodies[i];
  const BodyStep<S>& parent = bodies[b.parent];
  if (!b.slides) {
    const auto sc = lane::sincos(own.q);
    own.turn = {sc.cos, sc.sin};
  }
  own.w = parent.w, own.v = parent.v;
  into_body<K>(b, own, own.w, own.v);
  at<K>(b.slides ? own.v : own.w) += own.qd;
  own.origin = parent.origin;
  if (b.shifted || b.slides) own.origin += parent.axes * offset_of(b, own.q);
  own.axes = parent.axes;
  if (b.turned) own.axes = own.axes * turn_of<S>(b);
  if (b.slides) return;
  M3<S>& m = own.axes;
  const V3<S> i1 = pick<K + 1>(m.x, m.y, m.z), j1 = pick<K + 2>(m.x, m.y, m.z);
  pick<K + 1>(m.x, m.y, m.z) = i1 * own.turn.c + j1 * own.turn.s;
  pick<K + 2>(m.x, m.y, m.z) = j1 * own.turn.c - i1 * own.turn.s;
}

/// The inertia of a body alone, and the wrench it needs at its velocity.
template <class S>
MURO_INLINE Inertia<S> own_inertia(const Masses<S>& masses, int body, const V3<S>& w, const V3<S>& v) {
  S n[Mass::numbers];
  masses.load(body, n);
  const V3<S> h{n[1], n[2], n[3]}, wv = cross(w, v);
  const S m = n[0], zero(0);
  Inertia<S> o;
  o.A = {n[4], n[5], n[6], n[7], n[8], n[9]};
  o.B = {{zero, -h.z, h.y}, {h.z, zero, -h.x}, {-h.y, h.x, zero}};
  o.C = {m, m, m, zero, zero, zero};
  o.n = cross(w, o.A * w) + cross(h, wv);
  o.f = wv * m + cross(w, cross(w, h));
  return o;
}

/// The wrench by the velocity of a joint, as an acceleration: v x S qd.
template <int K, class S>
MURO_INLINE void add_velocity_terms(const Body& b, const BodyStep<S>& own, V3<S>& angular, V3<S>& linear) {
  if (b.slides) {
    add_across<K>(linear, own.w, own.qd);
  } else {
    add_across<K>(angular, own.w, own.qd);
    add_across<K>(linear, own.v, own.qd);
  }
}

/// Adds a body's inertia as its joint lets the parent feel it to the parent's slot. `external`: of contacts and
/// wrenches on the body, or null.
template <int K, class S>
[[gnu::noinline]] void fold(const Body& b, BodyStep<S>* bodies, int i, const Masses<S>& masses, Inertia<S>* slots,
                            const Inertia<S>* external) {
  constexpr int I = K + 1, J = K + 2;
  BodyStep<S>& own = bodies[i];
  Inertia<S> m = own_inertia<S>(masses, i, own.w, own.v);
  if (b.slot >= 0) m += slots[b.slot];
  if (external) m += *external;
  V3<S> Un, Uf;
  if (b.slides) {
    Un = {entry<0, K>(m.B), entry<1, K>(m.B), entry<2, K>(m.B)};
    at<K>(Uf) = diagonal<K>(m.C), at<I>(Uf) = opposite<J>(m.C), at<J>(Uf) = opposite<I>(m.C);
  } else {
    at<K>(Un) = diagonal<K>(m.A), at<I>(Un) = opposite<J>(m.A), at<J>(Un) = opposite<I>(m.A);
    Uf = {entry<K, 0>(m.B), entry<K, 1>(m.B), entry<K, 2>(m.B)};
  }
  own.Un = Un, own.Uf = Uf;
  own.D = at<K>(b.slides ? Uf : Un) + own.terms.inertia;
  own.bias = at<K>(b.slides ? m.f : m.n) - own.terms.effort;
  const S inverse = own.give = own.terms.is_free / own.D, go = own.terms.rate - inverse * own.bias;
  // less what the joint gives way
  const V3<S> n = Un * inverse, f = Uf * inverse;
  m.A.xx -= n.x * Un.x, m.A.yy -= n.y * Un.y, m.A.zz -= n.z * Un.z;
  m.A.yz -= n.y * Un.z, m.A.zx -= n.z * Un.x, m.A.xy -= n.x * Un.y;
  m.C.xx -= f.x * Uf.x, m.C.yy -= f.y * Uf.y, m.C.zz -= f.z * Uf.z;
  m.C.yz -= f.y * Uf.z, m.C.zx -= f.z * Uf.x, m.C.xy -= f.x * Uf.y;
  m.B.x -= Uf * n.x, m.B.y -= Uf * n.y, m.B.z -= Uf * n.z;
  // the wrench: of the velocity, and of the joint's acceleration
  V3<S> c{S(0), S(0), S(0)}, d = c;
  add_velocity_terms<K>(b, own, c, d);
  m.n += m.A * c + V3<S>{dot(m.B.x, d), dot(m.B.y, d), dot(m.B.z, d)} + Un * go;
  m.f += m.B.x * c.x + m.B.y * c.y + m.B.z * c.z + m.C * d + Uf * go;
  if (!b.slides) m = out_of<K>(own.turn, m);
  if (b.turned) m = out_of(turn_of<S>(b), m);
  if (b.shifted || b.slides) shift(m, offset_of(b, own.q));
  Inertia<S>& to = slots[b.parent_slot];
  if (b.first)
    to = m;
  else
    to += m;
}

/// The accelerations of a body and its joint from its parent's.
template <int K, class S>
MURO_INLINE void accelerate(const Body& b, BodyStep<S>* bodies, int i) {
  BodyStep<S>& own = bodies[i];
  own.alpha = bodies[b.parent].alpha, own.a = bodies[b.parent].a;
  into_body<K>(b, own, own.alpha, own.a);
  add_velocity_terms<K>(b, own, own.alpha, own.a);
  own.needed = own.bias + dot(own.Un, own.alpha) + dot(own.Uf, own.a);
  own.qdd = own.terms.rate - own.give * own.needed;
  at<K>(b.slides ? own.a : own.alpha) += own.qdd;
}

/// Calls `f` with the axis of the body's joint as a constant.
template <class F>
MURO_INLINE void with_axis(const Body& b, const F& f) {
  if (b.axis == 0)
    f.template operator()<0>();
  else if (b.axis == 1)
    f.template operator()<1>();
  else
    f.template operator()<2>();
}

/// Poses and velocities of all bodies from those of the base and of the joints.
template <class S>
void place_all(const Structure& s, BodyStep<S>* bodies) {
  for (int i = 1; i < s.count; ++i) with_axis(s.bodies[i], [&]<int K>() { place<K>(s.bodies[i], bodies, i); });
}

/// Accelerations of all bodies and joints. `external`: one for each body, or null; `base`: out, the inertia of a free
/// base with all that hangs on it; `fall`: m/s^2, the acceleration of a fixed base beyond gravity, in its frame.
template <class S>
void accelerate_all(const Structure& s, const Masses<S>& masses, BodyStep<S>* bodies, Inertia<S>* slots,
                    const Inertia<S>* const* external, Inertia<S>& base, const V3<S>& fall) {
  for (int i = s.count; i-- > 1;)
    with_axis(s.bodies[i], [&]<int K>() { fold<K>(s.bodies[i], bodies, i, masses, slots, external[i]); });
  if (s.fixed) {
    bodies[0].alpha = {S(0), S(0), S(0)}, bodies[0].a = fall;
  } else {
    base = own_inertia<S>(masses, 0, bodies[0].w, bodies[0].v);
    if (s.bodies[0].slot >= 0) base += slots[s.bodies[0].slot];
    if (external[0]) base += *external[0];
    solve(base, -base.n, -base.f, bodies[0].alpha, bodies[0].a);
  }
  for (int i = 1; i < s.count; ++i) with_axis(s.bodies[i], [&]<int K>() { accelerate<K>(s.bodies[i], bodies, i); });
}

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
