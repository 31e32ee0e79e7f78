// SPDX-License-Identifier: MIT
// Joints that follow others: constraints between two joints of the tree, exact within the step. When all that hangs on
// the anchor of a group is known, the efforts that make its joints follow depend only on the acceleration of the
// anchor, which feels them as an inertia (Featherstone, Rigid Body Dynamics Algorithms, section 8.3 for loop joints;
// elimination within the group as Jain, Robot and Multibody Dynamics, 2011, chapter 14, on constraint embedding).
#pragma once

#include "work.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

/// Puts mimic joints at the positions and velocities that follow from their leaders, in the robots `which`.
template <class S>
void follow_leaders(const Structure& s, const Work<S>& work, MaskOf<S> which) {
  for (int k = 1; k < s.count; ++k) {
    const Joint& j = s.joints[k];
    if (j.leader < 0) continue;
    const BodyStep<S>& leader = work.bodies[j.leader];
    BodyStep<S>& own = work.bodies[k];
    const S factor = factor_of<S>(s, k);
    own.q = select(which, S(s.bodies[k].sign * j.offset) + factor * leader.q, own.q);
    own.qd = select(which, factor * leader.qd, own.qd);
  }
}

/// Finds the response of body `i`, and adds the wrench that it hands on to the response of its parent.
template <int K, class S>
MURO_INLINE void respond(const Body& b, Work<S>& work, int i) {
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

/// Coupling of accelerate_all() for robots without mimic joints.
struct NoCoupling {
  MURO_INLINE void fold(int /*body*/) const {}
  MURO_INLINE void accelerate(int /*body*/) const {}
};

/// Coupling of accelerate_all() for robots with mimic joints.
template <class S>
class MimicJoints {
 public:
  /// Makes followers have the velocities of their leaders at the end of a step of 1 / `per_second` (s); 0: their
  /// accelerations.
  MURO_INLINE MimicJoints(const Structure& s, Work<S>& work, S per_second)
      : s_(s), work_(work), per_second_(per_second) {}

  MURO_INLINE void fold(int body) {
    for (; next_ < s_.mimic_group_count && s_.mimic_groups[next_].anchor == body; ++next_)
      fold_group(s_.mimic_groups[next_]);
  }
  MURO_INLINE void accelerate(int body) {
    for (; next_ > 0 && s_.mimic_groups[next_ - 1].anchor == body; --next_)
      accelerate_group(s_.mimic_groups[next_ - 1]);
  }

 private:
  struct Wrench {
    V3<S> n, f;
  };

  /// Finds the efforts of the group as functions of the acceleration of its anchor, and adds them to the anchor.
  [[gnu::noinline]] void fold_group(const MimicGroup& g) {
    S matrix[most_mimics][most_mimics];
    Wrench wrenches[most_mimics];
    Following<S> wanted[most_mimics];
    let_go(g);
    for (int i = 0; i < g.ways; ++i) {
      const int k = way(g, i).body;
      wrenches[i] = innovate(g, i);
      wanted[i] = {lag(k), wrenches[i].n, wrenches[i].f};
      find_mobilities(g, i, matrix[i]);
    }
    solve(matrix, wanted, g.ways);
    Inertia<S>& anchor = work_.slots[s_.bodies[g.anchor].slot];
    for (int i = 0; i < g.ways; ++i) {
      work_.followings[way(g, i).body] = wanted[i];
      add(wrenches[i], wanted[i], anchor);
    }
  }

  /// Adds the effect of the efforts to each joint of the group.
  [[gnu::noinline]] void accelerate_group(const MimicGroup& g) {
    const BodyStep<S>& anchor = work_.bodies[g.anchor];
    for (int i = 0; i < g.bodies; ++i) clear(body(g, i));
    for (int i = 0; i < g.ways; ++i) {
      const int k = way(g, i).body;
      const Following<S>& f = work_.followings[k];
      const S effort = f.start + dot(f.per_alpha, anchor.alpha) + dot(f.per_a, anchor.a);
      work_.responses[k].effort += effort;
      work_.responses[s_.joints[k].leader].effort -= factor_of<S>(s_, k) * effort;
    }
    for (int i = g.bodies; i-- > 0;) {
      const int k = body(g, i);
      respond_at(k);
      work_.bodies[k].bias += work_.responses[k].bias;
    }
  }

  MURO_INLINE int body(const MimicGroup& g, int place) const { return s_.mimic_bodies[g.first_body + place]; }
  MURO_INLINE const MimicWay& way(const MimicGroup& g, int i) const { return s_.mimic_ways[g.first_way + i]; }
  MURO_INLINE S* innovations(const MimicGroup& g, int i) const { return work_.innovations + i * g.bodies; }
  MURO_INLINE void clear(int k) {
    const S zero(0);
    work_.responses[k] = {{zero, zero, zero}, {zero, zero, zero}, zero, zero};
  }
  MURO_INLINE void respond_at(int k) {
    with_joint(s_.bodies[k], [&]<int K, bool>() { respond<K>(s_.bodies[k], work_, k); });
  }

  /// Accelerates the joints of the group without the efforts, while the anchor does not accelerate.
  void let_go(const MimicGroup& g) {
    const V3<S> zero{S(0), S(0), S(0)};
    work_.bodies[g.anchor].alpha = work_.bodies[g.anchor].a = zero;
    for (int i = 0; i < g.bodies; ++i) {
      const int k = body(g, i);
      with_joint(s_.bodies[k],
                 [&]<int K, bool plain>() { lanes::accelerate<K, plain>(s_.bodies[k], work_.bodies, k); });
    }
  }

  /// Returns the acceleration that a mimic joint lacks to follow its leader.
  MURO_INLINE S lag(int k) const {
    const auto rate = [&](int n) { return work_.bodies[n].qdd + work_.stages[n].qd * per_second_; };
    return rate(s_.joints[k].leader) * factor_of<S>(s_, k) - rate(k);
  }

  /// Finds the efforts that joints on the way lack by a unit effort of mimic joint i and the effort that this costs its
  /// leader. Returns the wrench that the anchor feels.
  Wrench innovate(const MimicGroup& g, int i) {
    const MimicWay& w = way(g, i);
    const int* const places = s_.mimic_places + w.first_place;
    S* const to = innovations(g, i);
    for (int n = 0; n < g.bodies; ++n) to[n] = S(0);
    clear(g.anchor);
    for (int n = 0; n < w.places; ++n) clear(body(g, places[n]));
    work_.responses[w.body].effort = S(1);
    work_.responses[s_.joints[w.body].leader].effort = -factor_of<S>(s_, w.body);
    for (int n = 0; n < w.places; ++n) {
      const int k = body(g, places[n]);
      respond_at(k);
      to[places[n]] = work_.responses[k].bias;
    }
    return {work_.responses[g.anchor].n, work_.responses[g.anchor].f};
  }

  /// Finds the acceleration that mimic joint i gains on its leader by a unit effort at each joint before it and at
  /// itself; the matrix is symmetric. The inverse of the matrix of inertia is (1 - H psi K)' D^-1 (1 - H psi K)
  /// (Rodriguez, Jain, Kreutz-Delgado, 1992).
  void find_mobilities(const MimicGroup& g, int i, S (&to)[most_mimics]) {
    const MimicWay& w = way(g, i);
    const int* const places = s_.mimic_places + w.first_place;
    const S* const own = innovations(g, i);
    S* const given = innovations(g, g.ways);
    for (int n = 0; n < w.places; ++n) given[n] = own[places[n]] * work_.bodies[body(g, places[n])].give;
    for (int m = 0; m <= i; ++m) {
      const S* const other = innovations(g, m);
      S sum(0);
      for (int n = 0; n < w.places; ++n) sum += other[places[n]] * given[n];
      to[m] = sum;
    }
  }

  /// Solves for a symmetric, positive matrix by its lower half. A row is zero when both joints are held.
  static void solve(S (&matrix)[most_mimics][most_mimics], Following<S> (&x)[most_mimics], int count) {
    const S zero(0);
    for (int i = 0; i < count; ++i) {
      const auto moves = matrix[i][i] > zero;
      const S inverse = select(moves, S(1) / select(moves, matrix[i][i], S(1)), zero);
      matrix[i][i] = inverse;
      for (int m = i + 1; m < count; ++m) {
        const S part = matrix[m][i] * inverse;
        for (int n = i + 1; n <= m; ++n) matrix[m][n] -= part * matrix[n][i];
        subtract(x[m], part, x[i]);
      }
    }
    for (int i = count; i-- > 0;) {
      x[i] = {x[i].start * matrix[i][i], x[i].per_alpha * matrix[i][i], x[i].per_a * matrix[i][i]};
      for (int m = i + 1; m < count; ++m) subtract(x[i], matrix[m][i] * matrix[i][i], x[m]);
    }
  }
  MURO_INLINE static void subtract(Following<S>& from, S factor, const Following<S>& x) {
    from.start -= factor * x.start;
    from.per_alpha = from.per_alpha - factor * x.per_alpha;
    from.per_a = from.per_a - factor * x.per_a;
  }

  /// Adds the effect of an effort on the anchor; `w` is the wrench of a unit effort.
  MURO_INLINE static void add(const Wrench& w, const Following<S>& x, Inertia<S>& to) {
    const V3<S>&p = x.per_alpha, &q = x.per_a;
    to.A.xx += w.n.x * p.x, to.A.yy += w.n.y * p.y, to.A.zz += w.n.z * p.z;
    to.A.yz += w.n.y * p.z, to.A.zx += w.n.z * p.x, to.A.xy += w.n.x * p.y;
    to.B.x += q * w.n.x, to.B.y += q * w.n.y, to.B.z += q * w.n.z;
    to.C.xx += w.f.x * q.x, to.C.yy += w.f.y * q.y, to.C.zz += w.f.z * q.z;
    to.C.yz += w.f.y * q.z, to.C.zx += w.f.z * q.x, to.C.xy += w.f.x * q.y;
    to.n += w.n * x.start, to.f += w.f * x.start;
  }

  const Structure& s_;
  Work<S>& work_;
  S per_second_;
  int next_ = 0;  ///< number of the next group
};

/// Finds the accelerations of all bodies and joints. `is_again`: only of what has changed since the last time, see
/// Work::changed.
template <class S>
MURO_INLINE void accelerate_all(const Structure& s, const Masses<S>& masses, Work<S>& work, const V3<S>& fall,
                                S per_second, bool is_again = false) {
  if (s.has_mimics) {
    accelerate_all(s, masses, work.bodies, work.slots, work.acts_on, work.base, fall,
                   MimicJoints<S>(s, work, per_second));
    return;
  }
  if (is_again) plan_folding(s, work.changed, work.folding);
  accelerate_all(s, masses, work.bodies, work.slots, work.acts_on, work.base, fall, NoCoupling(), work.kept,
                 is_again ? work.folding : nullptr);
}

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
