// SPDX-License-Identifier: MIT
#include "standing.hpp"

#include <cmath>

#include "muro/lane/rows.hpp"

namespace muro::penalty {
namespace {

using namespace lane;

/// As NormalLaw, over any scalar.
template <class S>
struct Normal {
  const StandingWork& w;
  S load, spring, damper, soft;

  MURO_INLINE Normal(const StandingWork& work, S load_) : w(work), load(load_) {
    const double o2 = w.omega * w.omega, beta = w.z + 0.25 * o2 * w.h * w.h;
    const S d = max(S(1 + beta), load * S(beta));
    spring = S(o2) / d;
    damper = S(0.5 * o2 * w.h + 2 * w.z / w.h) / d;
    soft = S(o2 * (1 + beta)) / d;
  }
  MURO_INLINE S force(S depth, S approach) const {
    const S h(w.h), zero(0);
    const S standing = depth + S(2 * w.zeta / w.omega) * approach;
    S f = max(spring * depth + damper * approach, zero);
    const auto part = (approach < zero) & (standing < -approach * h);
    if (any(part)) {
      const double o2 = w.omega * w.omega;
      const S held = S(o2) * standing * standing;
      const S parting = held / (sqrt(approach * approach + held) - approach) / h * (soft / S(o2));
      f = select(part, select(standing <= zero, zero, parting), f);
    }
    const auto meets = approach * h > depth;
    if (any(meets)) f = select(meets, at_meeting(depth, approach, meets), f);
    return f;
  }

 private:
  MURO_INLINE S at_meeting(S depth, S approach, MaskOf<S> meets) const {
    const double o2 = w.omega * w.omega;
    const S h(w.h), zero(0), one(1), half(0.5);
    const S since = h + depth / approach;
    const S z = tanh_of(S(w.zeta * w.omega) * since, meets);
    const S beta = z + S(0.25 * o2) * since * since;
    const S change = -(S(0.5 * o2) * since + S(2) * z / since) * approach / max(one + beta, load * beta);
    const S speed = approach + since * change, way = since * approach;
    const S dip = way + half * since * since * change;
    const S energy = min(speed * speed + soft * dip * dip, approach * approach);
    const S a = one + S(0.25) * soft * h * h, half_b = approach + half * soft * h * way;
    const S c = approach * approach + soft * way * way - energy;
    const S push = c / (half_b + sqrt(max(half_b * half_b - a * c, zero)));
    return max(min(push, approach - min(speed, zero)) / h, zero);
  }
  /// Value by value, of those that count: bodies meet rarely.
  MURO_INLINE static S tanh_of(S x, MaskOf<S> which) {
    if constexpr (count_of<S> == 1) {
      return std::tanh(x);
    } else {
      S r(0);
      for (int i = 0; i < count_of<S>; ++i)
        if (bits(which) >> i & 1) r.set(i, std::tanh(x[i]));
      return r;
    }
  }
};

/// As FrictionLaw.
template <class S>
struct Friction {
  S spring, damper, give;

  MURO_INLINE Friction(const StandingWork& w, S load) {
    const double o2 = w.omega * w.omega, beta = w.omega * w.h + 0.5 * o2 * w.h * w.h;
    const S d = max(S(1 + beta), load * S(beta));
    spring = S(o2) / d;
    damper = S(2 * w.omega + 0.5 * o2 * w.h) / d;
    give = S(-1) / spring;
  }
  MURO_INLINE V3<S> force(V3<S>& stretch, const V3<S>& slip, S most) const {
    V3<S> f = -(spring * stretch) - damper * slip;
    const S size2 = dot(f, f);
    const auto slides = size2 > most * most;
    if (any(slides)) {
      const S part = most / sqrt(size2), held = part * give;
      stretch = select(slides, held * f, stretch);
      f = select(slides, part * f, f);
    }
    return f;
  }
};

/// What resists a force on a robot. World axes.
template <class S>
struct Mobility {
  S mass;
  M3<S> inertia;
  V3<S> centre;
};

template <class S>
MURO_INLINE S trace(const M3<S>& m) {
  return m.x.x + m.y.y + m.z.z;
}
template <class S>
MURO_INLINE M3<S> transposed(const M3<S>& m) {
  return {{m.x.x, m.y.x, m.z.x}, {m.x.y, m.y.y, m.z.y}, {m.x.z, m.y.z, m.z.z}};
}
template <class S>
MURO_INLINE M3<S> operator+(const M3<S>& a, const M3<S>& b) {
  return {a.x + b.x, a.y + b.y, a.z + b.z};
}
template <class S>
MURO_INLINE M3<S> operator*(S s, const M3<S>& m) {
  return {s * m.x, s * m.y, s * m.z};
}
template <class S>
MURO_INLINE M3<S> outer(const V3<S>& a, const V3<S>& b) {
  return {a * b.x, a * b.y, a * b.z};
}
template <class S>
MURO_INLINE M3<S> diagonal(S s) {
  const S zero(0);
  return {{s, zero, zero}, {zero, s, zero}, {zero, zero, s}};
}

/// All contacts of a robot as one patch: see Patch and Resistance.
template <class S>
struct OnePatch {
  V3<S> normal, origin;
  S count;
  V3<S> sum;
  S xx, yy, zz, xy, xz, yz;

  MURO_INLINE void add(const V3<S>& point) {
    const V3<S> d = point - origin;
    sum += d;
    xx += d.x * d.x, yy += d.y * d.y, zz += d.z * d.z;
    xy += d.x * d.y, xz += d.x * d.z, yz += d.y * d.z;
  }
  /// Effective masses of each point along and across the normal (the latter inverse), and the load of the robot.
  MURO_INLINE void share(const Mobility<S>& body, S& along, S& inverse_across, S& load) const {
    const V3<S> r = origin + sum * (S(1) / count) - body.centre, lever = cross(r, normal);
    const S yields = dot(lever, body.inertia * lever);
    const S all = trace(body.inertia) * dot(r, r) - dot(r, body.inertia * r);
    along = S(1) / ((body.mass + yields) * count);
    inverse_across = S(0.5) * (S(2) * body.mass + all - yields) * count;
    const S across = S(1) / inverse_across, more = along - across;
    const V3<S> shift = origin - body.centre;
    const M3<S> mixed = outer(sum, shift);
    const M3<S> squares =
        M3<S>{{xx, xy, xz}, {xy, yy, yz}, {xz, yz, zz}} + mixed + transposed(mixed) + count * outer(shift, shift);
    const M3<S> shifts = count * (diagonal(across) + more * outer(normal, normal));
    // normal x squares x normal: the columns of squares crossed, then its rows
    const M3<S> half{cross(normal, squares.x), cross(normal, squares.y), cross(normal, squares.z)};
    const M3<S> rows = transposed(half);
    const M3<S> turned{cross(normal, rows.x), cross(normal, rows.y), cross(normal, rows.z)};
    const M3<S> turns = across * (diagonal(trace(squares)) + S(-1) * squares) + more * turned;
    const M3<S> x = body.inertia * turns, y = transposed(x);
    load = body.mass * sqrt(dot(shifts.x, shifts.x) + dot(shifts.y, shifts.y) + dot(shifts.z, shifts.z)) +
           sqrt(dot(x.x, y.x) + dot(x.y, y.y) + dot(x.z, y.z));
  }
};

template <class S>
struct Point {
  V3<S> at, normal;
  S depth;
};

template <class S>
MURO_INLINE unsigned push(const StandingWork& work, const StandingRobot* const* robots) {
  constexpr int n = count_of<S>;
  constexpr unsigned all = (1u << n) - 1;
  Places<S> contacts, base, twist, mass, old_grips;
  Places<S, double> grips, wrench;
  for (int i = 0; i < n; ++i) {
    contacts.at[i] = robots[i]->contacts;
    base.at[i] = robots[i]->base_pose;
    mass.at[i] = &robots[i]->mass->inverse_mass;
    old_grips.at[i] = grips.at[i] = robots[i]->grips;
    wrench.at[i] = robots[i]->wrench;
  }
  S p[7], m[4], inertia[6], tail[3];
  load_rows(base, 0, p);
  load_rows(mass, 0, m);
  load_rows(mass, 4, inertia);
  load_rows(mass, 10, tail);
  const V3<S> base_at{p[0], p[1], p[2]};
  const M3<S> axes = Q4<S>{p[3], p[4], p[5], p[6]}.matrix();
  const M3<S> own{
      {inertia[0], inertia[1], inertia[2]}, {inertia[3], inertia[4], inertia[5]}, {tail[0], tail[1], tail[2]}};
  const Mobility<S> body{m[0], axes * (own * transposed(axes)), base_at + axes * V3<S>{m[1], m[2], m[3]}};

  Point<S> points[most_contacts];
  OnePatch<S> patch;
  auto one = S(1) == S(1);
  for (int k = 0; k < work.contacts; ++k) {
    S c[7];
    load_rows(contacts, k * contact_stride, c);
    points[k] = {{c[0], c[1], c[2]}, {c[3], c[4], c[5]}, c[6]};
    const S zero(0);
    if (k == 0)
      patch = {
          points[0].normal, points[0].at, S(work.contacts), {zero, zero, zero}, zero, zero, zero, zero, zero, zero};
    one = one & (dot(patch.normal, points[k].normal) > S(work.same_direction));
    patch.add(points[k].at);
  }
  const unsigned served = bits(one) & all;
  S along, inverse_across, load;
  patch.share(body, along, inverse_across, load);
  const Normal<S> law(work, load);
  const Friction<S> friction(work, load);
  const S across = S(1) / inverse_across, elapsed(work.elapsed), zero(0);

  V3<S> force{zero, zero, zero}, torque = force;
  for (int group = 0, begin = 0; group < work.groups; begin = work.ends[group++]) {
    const int end = work.ends[group];
    Places<S> pose;
    for (int i = 0; i < n; ++i) {
      pose.at[i] = robots[i]->body_pose[group];
      twist.at[i] = robots[i]->body_twist[group];
    }
    S x[3], t[6];
    load_rows(pose, 0, x);
    load_rows(twist, 0, t);
    const V3<S> origin{x[0], x[1], x[2]}, linear{t[0], t[1], t[2]}, angular{t[3], t[4], t[5]};
    V3<S> old_at[most_contacts], old_stretch[most_contacts];
    for (int k = begin; k < end; ++k) {
      S g[6];
      load_rows(old_grips, k * grip_stride, g);
      old_at[k - begin] = {g[0], g[1], g[2]};
      old_stretch[k - begin] = {g[3], g[4], g[5]};
    }
    for (int k = begin; k < end; ++k) {
      const Point<S>& c = points[k];
      // The spring of the nearest point of the step before.
      V3<S> away = old_at[0] - c.at, stretch = old_stretch[0];
      S nearest = dot(away, away);
      for (int j = 1; j < end - begin; ++j) {
        away = old_at[j] - c.at;
        const S distance = dot(away, away);
        const auto nearer = distance < nearest;
        nearest = select(nearer, distance, nearest);
        stretch = select(nearer, old_stretch[j], stretch);
      }
      const V3<S> motion = linear + cross(angular, c.at - origin);
      const S approach = -dot(motion, c.normal);
      const V3<S> slip = motion + approach * c.normal;
      const S normal = along * law.force(c.depth, approach);
      stretch += slip * elapsed;
      stretch -= c.normal * dot(c.normal, stretch);
      const S mu = lane::load<S>(contacts, k * contact_stride + friction_number);
      const V3<S> f = normal * c.normal + across * friction.force(stretch, slip, mu * normal * inverse_across);
      store_rows(grips, k * grip_stride, {c.at.x, c.at.y, c.at.z, stretch.x, stretch.y, stretch.z}, served);
      force += f;
      torque += cross(c.at - base_at, f);
    }
  }
  store_rows(wrench, 0, {force.x, force.y, force.z, torque.x, torque.y, torque.z}, served);
  return ~served & all;
}

unsigned push_one(const StandingWork& work, const StandingRobot* const* robots) { return push<double>(work, robots); }
unsigned push_eight(const StandingWork& work, const StandingRobot* const* robots) {
  return push<Double8>(work, robots);
}

}  // namespace

namespace MURO_ISA {
extern const StandingKernels standing_kernels;
const StandingKernels standing_kernels{&push_one, &push_eight};
}  // namespace MURO_ISA

}  // namespace muro::penalty
