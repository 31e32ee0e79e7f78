// SPDX-License-Identifier: MIT
// Joints that follow others: constraints between two joints of the tree, exact within the step. The effort that holds
// one follows from what unit efforts do (Featherstone, Rigid Body Dynamics Algorithms, section 8.3 for loop joints).
#pragma once

#include "work.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

/// rate of the body's joint by that of its leader's.
template <class S>
MURO_INLINE S factor_of(const Structure& s, int k) {
  const Joint& j = s.joints[k];
  return S(j.multiplier * s.bodies[k].sign * s.bodies[j.leader].sign);
}

/// The wrench that a body's response hands on to its parent, and the way of an acceleration back.
template <int K, class S>
void respond_inwards(const Body& b, Work<S>& work, int i) {
  const BodyStep<S>& own = work.bodies[i];
  Response<S>& r = work.responses[i];
  r.bias = at<K>(b.slides ? r.f : r.n) - r.effort;
  const S go = -own.give * r.bias;
  V3<S> n = r.n + own.Un * go, f = r.f + own.Uf * go;
  if (!b.slides) n = out_of<K>(own.turn, n), f = out_of<K>(own.turn, f);
  if (b.turned) n = out_of(turn_of<S>(b), n), f = out_of(turn_of<S>(b), f);
  if (b.shifted || b.slides) n += cross(offset_of<false>(b, own.q), f);
  work.responses[b.parent].n += n, work.responses[b.parent].f += f;
}
template <int K, class S>
void respond_outwards(const Body& b, Work<S>& work, int i) {
  const BodyStep<S>& own = work.bodies[i];
  Response<S>& r = work.responses[i];
  r.alpha = work.responses[b.parent].alpha, r.a = work.responses[b.parent].a;
  into_body<K, false>(b, own, r.alpha, r.a);
  r.qdd = -own.give * (r.bias + dot(own.Un, r.alpha) + dot(own.Uf, r.a));
  at<K>(b.slides ? r.a : r.alpha) += r.qdd;
}

/// What the efforts in `work.responses` do beside all else. [after accelerate_all]
template <class S>
void respond(const Structure& s, Work<S>& work) {
  const V3<S> zero{S(0), S(0), S(0)};
  Response<S>* const r = work.responses;
  for (int i = 0; i < s.count; ++i) r[i].n = r[i].f = zero;
  for (int i = s.count; i-- > 1;)
    with_joint(s.bodies[i], [&]<int K, bool>() { respond_inwards<K>(s.bodies[i], work, i); });
  r[0].alpha = r[0].a = zero;
  if (!s.fixed) solve(work.base, -r[0].n, -r[0].f, r[0].alpha, r[0].a);
  for (int i = 1; i < s.count; ++i)
    with_joint(s.bodies[i], [&]<int K, bool>() { respond_outwards<K>(s.bodies[i], work, i); });
}

/// Finds the efforts with which mimic joints have the velocities of their leaders at the end of the step.
/// [after accelerate_all]
template <class S>
[[gnu::noinline]] void couple_mimic_joints(const Structure& s, Work<S>& work, double dt) {
  int followers[most_mimics], count = 0;
  S matrix[most_mimics][most_mimics], wanted[most_mimics];
  const S zero(0), per_second(1 / dt);
  for (int k = 1; k < s.count; ++k)
    if (s.joints[k].leader >= 0) followers[count++] = k;
  const auto lag = [&](int k, const auto& rate) { return rate(s.joints[k].leader) * factor_of<S>(s, k) - rate(k); };
  for (int i = 0; i < count; ++i) {
    const int k = followers[i];
    for (int n = 0; n < s.count; ++n) work.responses[n].effort = zero;
    work.responses[k].effort = S(1);
    work.responses[s.joints[k].leader].effort = -factor_of<S>(s, k);
    respond(s, work);
    for (int m = 0; m < count; ++m) matrix[m][i] = -lag(followers[m], [&](int n) { return work.responses[n].qdd; });
    wanted[i] = lag(k, [&](int n) { return work.bodies[n].qdd + work.bodies[n].qd * per_second; });
  }
  // symmetric and positive; a row of zeros where both joints are held
  for (int i = 0; i < count; ++i) {
    const auto moves = matrix[i][i] > zero;
    const S inverse = select(moves, S(1) / select(moves, matrix[i][i], S(1)), zero);
    for (int m = i + 1; m < count; ++m) {
      const S part = matrix[m][i] * inverse;
      for (int n = i; n < count; ++n) matrix[m][n] -= part * matrix[i][n];
      wanted[m] -= part * wanted[i];
    }
    matrix[i][i] = inverse;
  }
  for (int k = 0; k < s.count; ++k) work.couplings[k] = zero;
  for (int i = count; i-- > 0;) {
    for (int n = i + 1; n < count; ++n) wanted[i] -= matrix[i][n] * wanted[n];
    wanted[i] *= matrix[i][i];
    work.couplings[followers[i]] += wanted[i];
    work.couplings[s.joints[followers[i]].leader] -= factor_of<S>(s, followers[i]) * wanted[i];
  }
}

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
