// SPDX-License-Identifier: MIT
// The passes of the articulated-body algorithm (Featherstone, table 7.1) over any scalar of muro/simd. Joints are
// driven by efforts, or held (hybrid dynamics, section 9.2). Velocities and accelerations are spatial, in the frame of
// each body, at its origin. Accelerations are those beyond gravity.
#pragma once

#include "body_step.hpp"
#include "folding.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

/// Finds the velocity of a body from that of its parent. The rotation by its joint is known.
template <int K, bool plain, class S>
MURO_INLINE void find_velocity(const Body& b, BodyStep<S>* bodies, int i) {
  BodyStep<S>& own = bodies[i];
  const BodyStep<S>& parent = bodies[b.parent];
  V3<S> w = parent.w, v = parent.v;
  into_body<K, plain>(b, own, w, v);
  if (plain || !b.slides)
    at<K>(w) += own.qd;
  else
    at<K>(v) += own.qd;
  own.w = w, own.v = v;
}

/// Finds the pose of a body in the world from that of its parent.
template <int K, bool plain, class S>
MURO_INLINE void find_pose(const Body& b, BodyStep<S>* bodies, int i) {
  BodyStep<S>& own = bodies[i];
  const BodyStep<S>& parent = bodies[b.parent];
  M3<S> m = parent.axes;
  own.origin = b.shifted || (!plain && b.slides) ? parent.origin + m * offset_of<plain>(b, own.q) : parent.origin;
  if (!plain && b.turned) m = m * turn_of<S>(b);
  if (plain || !b.slides) {
    const V3<S> i1 = pick<K + 1>(m.x, m.y, m.z), j1 = pick<K + 2>(m.x, m.y, m.z);
    pick<K + 1>(m.x, m.y, m.z) = i1 * own.turn.c + j1 * own.turn.s;
    pick<K + 2>(m.x, m.y, m.z) = j1 * own.turn.c - i1 * own.turn.s;
  }
  own.axes = m;
}
template <int K, bool plain, class S>
[[gnu::noinline]] void place(const Body& b, BodyStep<S>* bodies, int i) {
  if (plain || !b.slides) bodies[i].turn = turn_by(bodies[i].q);
  find_velocity<K, plain>(b, bodies, i);
  find_pose<K, plain>(b, bodies, i);
}

/// Returns the inertia of a body with what waits for it in `slot` (may be null), and the wrench that it needs at its
/// velocity.
template <class S>
MURO_INLINE Inertia<S> gathered(const Masses<S>& masses, int body, const V3<S>& w, const V3<S>& v,
                                const Inertia<S>* slot) {
  S n[Mass::numbers];
  masses.load(body, n);
  const V3<S> h{n[1], n[2], n[3]}, wv = cross(w, v);
  const Sym<S> A{n[4], n[5], n[6], n[7], n[8], n[9]};
  const S m = n[0], zero(0);
  Inertia<S> o;
  o.n = cross(w, A * w) + cross(h, wv);
  o.f = wv * m + cross(w, cross(w, h));
  if (!slot) {
    o.A = A;
    o.B = {{zero, -h.z, h.y}, {h.z, zero, -h.x}, {-h.y, h.x, zero}};
    o.C = {m, m, m, zero, zero, zero};
    return o;
  }
  const Inertia<S>& s = *slot;
  o.A = {s.A.xx + A.xx, s.A.yy + A.yy, s.A.zz + A.zz, s.A.yz + A.yz, s.A.zx + A.zx, s.A.xy + A.xy};
  o.B.x = {s.B.x.x, s.B.x.y - h.z, s.B.x.z + h.y};
  o.B.y = {s.B.y.x + h.z, s.B.y.y, s.B.y.z - h.x};
  o.B.z = {s.B.z.x - h.y, s.B.z.y + h.x, s.B.z.z};
  o.C = {s.C.xx + m, s.C.yy + m, s.C.zz + m, s.C.yz, s.C.zx, s.C.xy};
  o.n += s.n, o.f += s.f;
  return o;
}
/// Returns the inertia and wrench of a body alone.
template <class S>
MURO_INLINE Inertia<S> own_inertia(const Masses<S>& masses, int body, const V3<S>& w, const V3<S>& v) {
  return gathered<S>(masses, body, w, v, nullptr);
}

/// The two components across axis K of the acceleration v x S qd, which the velocity of a joint causes. For a hinge,
/// also those of the angular acceleration.
template <int K, bool plain, class S>
struct VelocityTerms {
  S ci, cj, di, dj;  ///< angular and linear, along the axes that follow K

  MURO_INLINE VelocityTerms(const Body& b, const BodyStep<S>& own) {
    constexpr int I = K + 1, J = K + 2;
    if (plain || !b.slides) {
      ci = at<J>(own.w) * own.qd, cj = -(at<I>(own.w) * own.qd);
      di = at<J>(own.v) * own.qd, dj = -(at<I>(own.v) * own.qd);
    } else {
      ci = cj = S(0);
      di = at<J>(own.w) * own.qd, dj = -(at<I>(own.w) * own.qd);
    }
  }
};

/// Adds the inertia that a body hands on to the parent's slot.
template <class S>
MURO_INLINE void hand_on(const Body& b, const Inertia<S>& m, Inertia<S>* slots) {
  Inertia<S>& to = slots[b.parent_slot];
  if (b.first)
    to = m;
  else
    to += m;
}

/// Adds the inertia of a body to the parent's slot, as the parent feels it through the joint. `external`: terms of
/// contacts and wrenches on the body, or null; `kept`: out, the inertia that is handed on, or null.
template <int K, bool plain, class S>
[[gnu::noinline]] void fold(const Body& b, BodyStep<S>* bodies, int i, const Masses<S>& masses, Inertia<S>* slots,
                            const Inertia<S>* external, Inertia<S>* kept) {
  constexpr int I = K + 1, J = K + 2;
  BodyStep<S>& own = bodies[i];
  const bool slides = !plain && b.slides;
  Inertia<S> m = gathered<S>(masses, i, own.w, own.v, b.slot >= 0 ? slots + b.slot : nullptr);
  if (external) m += *external;
  V3<S> Un, Uf;
  if (slides) {
    Un = {entry<0, K>(m.B), entry<1, K>(m.B), entry<2, K>(m.B)};
    at<K>(Uf) = diagonal<K>(m.C), at<I>(Uf) = opposite<J>(m.C), at<J>(Uf) = opposite<I>(m.C);
  } else {
    at<K>(Un) = diagonal<K>(m.A), at<I>(Un) = opposite<J>(m.A), at<J>(Un) = opposite<I>(m.A);
    Uf = {entry<K, 0>(m.B), entry<K, 1>(m.B), entry<K, 2>(m.B)};
  }
  own.Un = Un, own.Uf = Uf;
  own.D = at<K>(slides ? Uf : Un) + own.terms.inertia;
  own.bias = at<K>(slides ? m.f : m.n) - own.terms.effort;
  const S inverse = own.give = own.terms.is_free / own.D, go = own.terms.rate - inverse * own.bias;
  // minus the part that the joint gives way
  const V3<S> n = Un * inverse, f = Uf * inverse;
  m.A.xx -= n.x * Un.x, m.A.yy -= n.y * Un.y, m.A.zz -= n.z * Un.z;
  m.A.yz -= n.y * Un.z, m.A.zx -= n.z * Un.x, m.A.xy -= n.x * Un.y;
  m.C.xx -= f.x * Uf.x, m.C.yy -= f.y * Uf.y, m.C.zz -= f.z * Uf.z;
  m.C.yz -= f.y * Uf.z, m.C.zx -= f.z * Uf.x, m.C.xy -= f.x * Uf.y;
  m.B.x -= Uf * n.x, m.B.y -= Uf * n.y, m.B.z -= Uf * n.z;
  // the wrench by the velocity and by the acceleration of the joint
  m.n += Un * go, m.f += Uf * go;
  const VelocityTerms<K, plain, S> t(b, own);
  at<K>(m.n) += entry<K, I>(m.B) * t.di + entry<K, J>(m.B) * t.dj;
  at<I>(m.n) += entry<I, I>(m.B) * t.di + entry<I, J>(m.B) * t.dj;
  at<J>(m.n) += entry<J, I>(m.B) * t.di + entry<J, J>(m.B) * t.dj;
  at<K>(m.f) += opposite<J>(m.C) * t.di + opposite<I>(m.C) * t.dj;
  at<I>(m.f) += diagonal<I>(m.C) * t.di + opposite<K>(m.C) * t.dj;
  at<J>(m.f) += opposite<K>(m.C) * t.di + diagonal<J>(m.C) * t.dj;
  if (!slides) {
    at<K>(m.n) += opposite<J>(m.A) * t.ci + opposite<I>(m.A) * t.cj;
    at<I>(m.n) += diagonal<I>(m.A) * t.ci + opposite<K>(m.A) * t.cj;
    at<J>(m.n) += opposite<K>(m.A) * t.ci + diagonal<J>(m.A) * t.cj;
    at<K>(m.f) += entry<I, K>(m.B) * t.ci + entry<J, K>(m.B) * t.cj;
    at<I>(m.f) += entry<I, I>(m.B) * t.ci + entry<J, I>(m.B) * t.cj;
    at<J>(m.f) += entry<I, J>(m.B) * t.ci + entry<J, J>(m.B) * t.cj;
    m = out_of<K>(own.turn, m);
  }
  if (!plain && b.turned) m = out_of(turn_of<S>(b), m);
  if (b.shifted || slides) shift(m, offset_of<plain>(b, own.q));
  if (b.kept && kept) *kept = m;
  hand_on(b, m, slots);
}

/// Returns the inertia that moves with a joint (kg m^2 or kg) when only its effort moves it. The body is folded.
template <class S>
MURO_INLINE S moved_inertia(const Body& b, const BodyStep<S>& own) {
  const V3<S>& u = b.slides ? own.Uf : own.Un;
  return b.axis == 0 ? u.x : b.axis == 1 ? u.y : u.z;
}

/// Finds the accelerations of a body and its joint from those of its parent.
template <int K, bool plain, class S>
MURO_INLINE void accelerate(const Body& b, BodyStep<S>* bodies, int i) {
  BodyStep<S>& own = bodies[i];
  V3<S> alpha = bodies[b.parent].alpha, a = bodies[b.parent].a;
  into_body<K, plain>(b, own, alpha, a);
  const VelocityTerms<K, plain, S> t(b, own);
  if (plain || !b.slides) at<K + 1>(alpha) += t.ci, at<K + 2>(alpha) += t.cj;
  at<K + 1>(a) += t.di, at<K + 2>(a) += t.dj;
  own.needed = own.bias + dot(own.Un, alpha) + dot(own.Uf, a);
  own.qdd = own.terms.rate - own.give * own.needed;
  if (plain || !b.slides)
    at<K>(alpha) += own.qdd;
  else
    at<K>(a) += own.qdd;
  own.alpha = alpha, own.a = a;
}

/// Calls `f` with the axis of the body's joint, and whether the body is plain, as constants.
template <class F>
MURO_INLINE void with_joint(const Body& b, const F& f) {
  const bool plain = !b.slides && !b.turned;
  if (b.axis == 0)
    plain ? f.template operator()<0, true>() : f.template operator()<0, false>();
  else if (b.axis == 1)
    plain ? f.template operator()<1, true>() : f.template operator()<1, false>();
  else
    plain ? f.template operator()<2, true>() : f.template operator()<2, false>();
}

/// Finds poses and velocities of all bodies from those of the base and of the joints.
template <class S>
void place_all(const Structure& s, BodyStep<S>* bodies) {
  for (int i = 1; i < s.count; ++i)
    with_joint(s.bodies[i], [&]<int K, bool plain>() { place<K, plain>(s.bodies[i], bodies, i); });
}

/// Finds the velocities alone: bodies are where they were placed, and the base and joints have other velocities.
template <class S>
void find_velocities(const Structure& s, BodyStep<S>* bodies) {
  for (int i = 1; i < s.count; ++i)
    with_joint(s.bodies[i], [&]<int K, bool plain>() { find_velocity<K, plain>(s.bodies[i], bodies, i); });
}

/// Finds the accelerations of all bodies and joints. `external`: one for each body, or null; `base`: out, the inertia
/// of a free base with all that hangs on it; `fall`: m/s^2, the acceleration of a fixed base beyond gravity, in its
/// frame; `kept`: one for each body, or null; `folding`: the bodies to fold again after a first time, or null.
/// `coupling` is called when all that hangs on a body is known, and when the acceleration of the body is.
template <class S, class Coupling>
void accelerate_all(const Structure& s, const Masses<S>& masses, BodyStep<S>* bodies, Inertia<S>* slots,
                    const Inertia<S>* const* external, Inertia<S>& base, const V3<S>& fall, Coupling&& coupling,
                    Inertia<S>* kept = nullptr, const Folding* folding = nullptr) {
  for (int i = s.count; i-- > 1;) {
    coupling.fold(i);
    if (folding && folding[i] != Folding::whole) {
      if (folding[i] == Folding::kept) hand_on(s.bodies[i], kept[i], slots);
      continue;
    }
    with_joint(s.bodies[i], [&]<int K, bool plain>() {
      fold<K, plain>(s.bodies[i], bodies, i, masses, slots, external[i], kept ? kept + i : nullptr);
    });
  }
  coupling.fold(0);
  if (s.fixed) {
    bodies[0].alpha = {S(0), S(0), S(0)}, bodies[0].a = fall;
  } else {
    const int slot = s.bodies[0].slot;
    base = gathered<S>(masses, 0, bodies[0].w, bodies[0].v, slot >= 0 ? slots + slot : nullptr);
    if (external[0]) base += *external[0];
    solve(base, -base.n, -base.f, bodies[0].alpha, bodies[0].a);
  }
  coupling.accelerate(0);
  for (int i = 1; i < s.count; ++i) {
    with_joint(s.bodies[i], [&]<int K, bool plain>() { accelerate<K, plain>(s.bodies[i], bodies, i); });
    coupling.accelerate(i);
  }
}

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
