// SPDX-License-Identifier: MIT
// The inertia and wrench that a contact adds to a body, so that its force is that of the end of the step. Along the
// normal, a spring and a damper only push. Across it, a spring beside a damper acts while the contact sticks; while it
// slides, the friction cone limits both. Linearly implicit: force = start - K (acceleration of the point), with K = dt
// (damping + dt stiffness), goes into the articulated inertia as J' K J. So the whole robot responds at no extra pass,
// and neither light feet nor hard ground limit the step.
#pragma once

#include "plugins/common/contact_geometry/contact_load.hpp"
#include "spatial.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

using lane::MaskOf, lane::max, lane::min, lane::select, lane::sqrt;

/// m/s: a slower spin lets no contact slip that is at rest.
inline constexpr double least_cell_speed = 5e-6;

/// A contact point of as many robots as S has values. Vectors are in the frame of the body.
template <class S>
struct ContactPoint {
  V3<S> arm;           ///< m, from the body's origin
  V3<S> turn;          ///< m: velocity of the point of friction against the contact point, for 1 rad/s about the normal
  V3<S> normal;        ///< unit, into the body
  S depth;             ///< m; below 0 where there is no contact
  V3<S> spin;          ///< rad/s: spin of the body against what it touches, if the surface resists turning
  V3<S> displacement;  ///< m: stretch of the friction spring, across the normal
  S friction;          ///< coefficient
  S restitution;
  S load;        ///< N: the normal force that bounds friction
  S push;        ///< N: force of spring and damper along the normal, see soft_push()
  S speed;       ///< m/s: velocity along the normal against what it touches
  V3<S> slip;    ///< m/s: slip of the point of friction across the normal; friction is linear about it
  S pushed;      ///< m/s: change of its velocity along the normal by other forces, if that is known
  S gained;      ///< m/s: increase of its approach since it touched, if that is known
  S is_on;       ///< 1; 0: it does not push in this step
  S sticks;      ///< 1: it sticks at any force, since it would turn back within the step
  S drags;       ///< 1: across the normal it is a damper of `drag`
  S drag;        ///< N s/m
  S cell_speed;  ///< m/s: speed of the ends of its cell about the point of friction, see give_of_cell()
};
/// Resistance against rolling and spinning of the same point.
template <class S>
struct TurningPoint {
  V3<S> displacement;   ///< rad: turn of the spring
  S rolling, spinning;  ///< m
};

/// The law of all contact points of a robot.
template <class S>
struct ContactLaw {
  S stiffness, damping;  ///< N/m, N s/m: along the normal; also of the friction spring and its damper
  S held;                ///< N s/m: damping + dt stiffness
  S mass;                ///< kg: mass that contacts may have to bear
  S impact_speed;        ///< m/s: a faster point rebounds
  S hard_speed;          ///< m/s: a faster point is stopped at once
  S radius;              ///< m: lever of the springs against rolling and spinning
  S most_depth;          ///< m: depth that acts at an overlap of a tenth of a metre and more; less at a smaller one
  S least_cap;           ///< m: acting depth at which one contact bears the robot twice
  S for_weight;          ///< N/m: part of `stiffness` that bears the robot
  S most_more;           ///< N: largest force of the rest of `stiffness`
};

/// Response of a contact in a step, for use after the step is solved.
template <class S>
struct ContactStep {
  V3<S> start;      ///< N: force without acceleration
  S along, across;  ///< kg: K = across (1 - t t') + along n n' where it slides, else across 1 + (along - across) n n'
  V3<S> slide;      ///< unit: direction t in which it slides; 0 when it sticks
  bool slides;      ///< in some robot, the contact slides
  S held;           ///< N s/m: change of sticking friction by the slip at the end of the step
  V3<S> torque;     ///< N m: against rolling and spinning, without acceleration; if some surface resists that
  S rolling, spinning;  ///< kg m^2: change of `torque` by the angular acceleration

  /// Returns the force at the end of the step (N). `a`: m/s^2, of the point; across the normal, of the point of
  /// friction.
  MURO_INLINE V3<S> force(const V3<S>& normal, const V3<S>& a) const {
    V3<S> change = a;
    if (slides) change = select(dot(slide, slide) > S(0), a - dot(slide, a) * slide, a);
    return start - (across * change + ((along - across) * dot(normal, a)) * normal);
  }
  /// Returns the torque at the end of the step (N m). `alpha`: rad/s^2, of the body.
  MURO_INLINE V3<S> moment(const V3<S>& normal, const V3<S>& alpha) const {
    return torque - (rolling * alpha + ((spinning - rolling) * dot(normal, alpha)) * normal);
  }
};

/// A spring of `stiffness` beside a damper, whose force has a limit.
template <class S>
struct BoundedSpring {
  V3<S> force;  ///< force at the rate `at`, with the spring of the end of the step
  S per_rate;   ///< change of the force per change of the rate within the step
  V3<S> slide;  ///< unit: the direction along which the force does not change; 0 for none
  bool slides;  ///< in some robot: `slide` is not 0

  /// `held`: damping + dt stiffness; `counts`: robots for which the result is used.
  MURO_INLINE BoundedSpring(const V3<S>& displacement, const V3<S>& at, S stiffness, S held, S limit,
                            MaskOf<S> counts) {
    const V3<S> hold = stiffness * displacement + held * at;
    const S square = dot(hold, hold);
    const MaskOf<S> holds = ((limit > S(0)) & (square <= limit * limit)) | !counts;
    slide = {S(0), S(0), S(0)}, per_rate = held, force = -hold;
    slides = lane::bits(holds) != lane::all_lanes<S>;
    if (!slides) return;
    const S by_size = S(1) / sqrt(max(square, S(1e-24))), part = limit * by_size;
    slide = hold * select(holds, S(0), by_size);
    per_rate = select(holds, held, part * held);
    force = -select(holds, hold, part * hold);
  }
};

/// A point represents a cell of a line or face that touches. When that spins, the ends of the cell move against its
/// middle. While the ends are faster than the middle, the friction of the cell is less than its limit, by the ratio of
/// both speeds. This is a damper in series with the spring. Returns the part of spring and damper that remains. `held`:
/// N s/m, of these; `limit`: N.
template <class S>
MURO_INLINE S give_of_cell(const ContactPoint<S>& p, S held, S limit) {
  return select(p.cell_speed > S(0), limit / max(limit + held * p.cell_speed, S(1e-300)), S(1));
}

/// Adds x 1 + (y - x) n n' to a symmetric matrix.
template <class S>
MURO_INLINE void add_about(Sym<S>& to, S x, S y, const V3<S>& n) {
  const V3<S> b = n * (y - x);
  to.xx += x + b.x * n.x, to.yy += x + b.y * n.y, to.zz += x + b.z * n.z;
  to.yz += b.y * n.z, to.zx += b.z * n.x, to.xy += b.x * n.y;
}

/// Subtracts J' x t t' J.
template <class S>
MURO_INLINE void take_along(const V3<S>& r, const V3<S>& t, S x, Inertia<S>& to) {
  const V3<S> m = cross(r, t), a = m * x, c = t * x;
  to.A.xx -= a.x * m.x, to.A.yy -= a.y * m.y, to.A.zz -= a.z * m.z;
  to.A.yz -= a.y * m.z, to.A.zx -= a.z * m.x, to.A.xy -= a.x * m.y;
  to.B.x -= t * a.x, to.B.y -= t * a.y, to.B.z -= t * a.z;
  to.C.xx -= c.x * t.x, to.C.yy -= c.y * t.y, to.C.zz -= c.z * t.z;
  to.C.yz -= c.y * t.z, to.C.zx -= c.z * t.x, to.C.xy -= c.x * t.y;
}

/// Adds J' K J and J' start. `has_cells`: friction may act beside the point. The spin about the normal moves that place
/// by `turn`, so it is farther by turn x normal.
template <class S>
MURO_INLINE void add_terms(const ContactPoint<S>& p, const ContactStep<S>& c, bool has_cells, Inertia<S>& to) {
  const V3<S>&n = p.normal, m = cross(p.arm, n);
  const S x = c.across;
  V3<S> r = p.arm, b = m * (c.along - x);
  if (has_cells) r += cross(p.turn, n), b += x * p.turn;
  Sym<S> o = {b.x * m.x, b.y * m.y, b.z * m.z, b.y * m.z, b.z * m.x, b.x * m.y};
  if (has_cells) {
    const V3<S> k = m - p.turn, h = x * p.turn;
    o = {o.xx + k.x * h.x, o.yy + k.y * h.y, o.zz + k.z * h.z, o.yz + k.y * h.z, o.zx + k.z * h.x, o.xy + k.x * h.y};
  }
  const S rr = dot(r, r);
  to.A.xx += x * (rr - r.x * r.x) + o.xx;
  to.A.yy += x * (rr - r.y * r.y) + o.yy;
  to.A.zz += x * (rr - r.z * r.z) + o.zz;
  to.A.yz += o.yz - x * (r.y * r.z);
  to.A.zx += o.zx - x * (r.z * r.x);
  to.A.xy += o.xy - x * (r.x * r.y);
  to.B.x += V3<S>{b.x * n.x, b.x * n.y - x * r.z, b.x * n.z + x * r.y};
  to.B.y += V3<S>{b.y * n.x + x * r.z, b.y * n.y, b.y * n.z - x * r.x};
  to.B.z += V3<S>{b.z * n.x - x * r.y, b.z * n.y + x * r.x, b.z * n.z};
  add_about(to.C, x, c.along, n);
  if (c.slides) take_along(r, c.slide, x, to);
  to.f -= c.start;
  to.n -= cross(p.arm, c.start);
  if (has_cells) to.n -= dot(p.turn, c.start) * n;
}

/// Returns the force of spring and damper along the normal (N). `speed`: m/s, away from what is touched.
template <class S>
MURO_INLINE S soft_push(const ContactPoint<S>& p, const ContactLaw<S>& law, S speed) {
  const S own = law.for_weight * contact_geometry::parted_depth(p.depth, law.most_depth, law.least_cap);
  return own + min((law.stiffness - law.for_weight) * p.depth, law.most_more) - law.held * speed;
}

/// Whether a point pushes: it overlaps, and does not leave faster than its spring and damper, or after a rebound.
/// `push`: result of soft_push().
template <class S>
MURO_INLINE MaskOf<S> pushes(const ContactPoint<S>& p, const ContactLaw<S>& law, S speed, S push) {
  const MaskOf<S> is_in = p.depth > S(0), is_elastic = p.restitution > S(0);
  if (!lane::any(is_elastic)) return is_in & (push > S(0));
  const auto rebounds = is_elastic & (speed + p.pushed > law.impact_speed);
  const auto is_hit = is_elastic & (speed + p.pushed < -law.impact_speed);
  return is_in & ((push > S(0)) | is_hit) & !rebounds;
}

/// Returns the expected normal force (N), for the friction of a point whose last load is not known.
template <class S>
MURO_INLINE S expected_load(const ContactPoint<S>& p, const ContactLaw<S>& law, S speed, S push, double dt) {
  return max(min(push, law.mass * S(1 / dt) * max(-speed, S(0)) + law.stiffness * p.depth), S(0));
}

/// Whether a point is stopped or thrown back within a step. `approach`: m/s, away from what is touched.
template <class S>
MURO_INLINE MaskOf<S> is_impact(const ContactPoint<S>& p, const ContactLaw<S>& law, S approach) {
  return ((p.restitution > S(0)) & (approach < -law.impact_speed)) | (approach < -law.hard_speed);
}

/// Finds the response of a contact. `velocity`: m/s, of the point against what it touches; `more`: m/s^2, cross(w, v)
/// of the body and gravity, in its frame, since accelerations are beyond these; `spins`: see ContactSlot; `dt`: s;
/// `is_first`: in the first trial, when friction is linear about the slip at the begin of the step. The way from the
/// body's origin to the point is assumed not to turn beyond the turn that `velocity` contains.
template <bool is_first, class S>
MURO_INLINE void touch(const ContactPoint<S>& p, const ContactLaw<S>& law, const V3<S>& velocity, const V3<S>& more,
                       bool spins, double dt, ContactStep<S>& c) {
  const S h(dt), zero(0);
  const V3<S> none{zero, zero, zero};
  const S speed = p.speed;
  const MaskOf<S> is_on = p.is_on > zero;
  // along the normal: spring and damper; an impact reaches the velocity of its rebound at any force
  S push = p.push, along = h * law.held;
  c.held = law.held;
  const S approach = speed + p.pushed;
  const auto is_hit = is_impact(p, law, approach);
  if (lane::any(is_hit)) {
    constexpr double hardness = 1e4;
    const S impact_damping = S(hardness / dt) * law.mass;
    const S rebound = max(-p.restitution * approach - (S(1) + p.restitution) * p.gained, zero);
    push = select(is_hit, -impact_damping * (speed - rebound), push);
    along = select(is_hit, h * impact_damping, along);
    c.held = select(is_hit, impact_damping, c.held);
  }
  const S limit = p.friction * p.load, give = spins ? give_of_cell(p, c.held, limit) : S(1);
  BoundedSpring<S> hold(p.displacement, p.slip, law.stiffness * give, c.held * give, limit, is_on & !(p.sticks > zero));
  const MaskOf<S> drags = p.drags > zero;
  if (lane::any(drags)) {
    hold.force = select(drags, -p.drag * p.slip, hold.force);
    hold.per_rate = select(drags, p.drag, hold.per_rate);
    hold.slide = select(drags, none, hold.slide);
  }
  c.along = select(is_on, along, zero), c.across = select(is_on, h * hold.per_rate, zero);
  c.slide = hold.slide, c.slides = hold.slides;
  V3<S> friction = hold.force;
  if (!is_first) {
    V3<S> change = velocity - speed * p.normal - p.slip;
    if (c.slides) change = change - dot(c.slide, change) * c.slide;
    friction -= hold.per_rate * change;
  }
  c.start = select(is_on, push * p.normal + friction, none);
  c.start = c.force(p.normal, more);
}

/// Adds the resistance of the point against rolling and spinning to `c` and to the inertia of the body.
template <class S>
MURO_INLINE void resist(const ContactPoint<S>& p, const TurningPoint<S>& t, const ContactLaw<S>& law, double dt,
                        ContactStep<S>& c, Inertia<S>& to) {
  const S h(dt), square = law.radius * law.radius, stiffness = law.stiffness * square, held = law.held * square;
  const MaskOf<S> is_on = p.is_on > S(0);
  const V3<S> about = dot(p.spin, p.normal) * p.normal, across = p.spin - about;
  const V3<S> wound = dot(t.displacement, p.normal) * p.normal, rolled = t.displacement - wound;
  const BoundedSpring<S> roll(rolled, across, stiffness, held, t.rolling * p.load, is_on),
      spin(wound, about, stiffness, held, t.spinning * p.load, is_on);
  c.torque = p.is_on * (roll.force + spin.force);
  c.rolling = p.is_on * h * roll.per_rate, c.spinning = p.is_on * h * spin.per_rate;
  add_about(to.A, c.rolling, c.spinning, p.normal);
  to.n -= c.torque;
}

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
