// SPDX-License-Identifier: MIT
// Contacts of a step are solved by trial. Each is tried in its state of the last step. If the result does not fit that
// state, the next trial uses the state that follows from the result.
#pragma once

#include "work.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

/// Result of a contact after a trial, in the frame of the body.
template <class S>
struct ContactOutcome {
  V3<S> force;     ///< N
  S load;          ///< N: force along the normal
  V3<S> velocity;  ///< m/s: velocity of the point against what it touches, at the end of the step
  V3<S> slip;      ///< m/s: the part of `velocity` across the normal
};

/// Returns the load (N) at which friction and load agree, estimated from two trials (the secant method).
template <class S>
MURO_INLINE S likely_load(const ContactSlot<S>& slot, S found) {
  const S change = slot.point.load - slot.tried_load, slope = (found - slot.found_load) / change;
  const S meet = (found - slope * slot.point.load) / (S(1) - slope);
  const auto tells = (slot.found_load >= S(0)) & (change * change > S(0)) & (slope < S(0.5));
  return select(tells, max(meet, S(0)), found);
}

/// Stage of the search for the states of contacts.
enum class Search {
  pieces,  ///< each contact takes the piece of its law that it has reached
  drags,   ///< a contact without a solution is a damper with the force of friction, which never turns back
  yields,  ///< a contact still without a solution is a weaker damper, if that stays within its cone
  ends,    ///< a contact still without a solution has no friction
};

/// Difference between the state in which a contact was tried and its result.
template <class S>
struct Misfit {
  MaskOf<S> any;          ///< one of the following cases
  MaskOf<S> is_drawn;     ///< the contact pulls
  MaskOf<S> pushes_now;   ///< it was tried without a force, but would push
  MaskOf<S> is_off_cone;  ///< its friction does not fit its slip and its load
  MaskOf<S> turns_back;   ///< part of `is_off_cone`: it slid, and its friction would now push it on
  V3<S> across;           ///< N: friction of the trial
  S most;                 ///< N: largest friction
  S held;                 ///< N s/m: sticking friction at this load, per slip at the end of the step
};

/// Compares a trial with its result. `weight`: N, of the robot.
template <class S>
MURO_INLINE Misfit<S> misfit(const ContactSlot<S>& slot, const ContactOutcome<S>& o, const ContactLaw<S>& law, S weight,
                             Search search) {
  const ContactPoint<S>& p = slot.point;
  const S zero(0), load = max(o.load, zero);
  const MaskOf<S> is_on = p.is_on > zero;
  Misfit<S> m;
  m.is_drawn = is_on & (o.load < zero);
  m.across = o.force - o.load * p.normal;
  const S most = p.friction * load, give = slot.spins ? give_of_cell(p, slot.step.held, most) : S(1);
  m.held = slot.step.held * give;
  const V3<S> hold = (law.stiffness * give) * p.displacement + m.held * o.slip;
  const S square = dot(hold, hold);
  const MaskOf<S> is_small = square <= most * most;
  S part(-1);
  if (lane::bits(is_small) != lane::all_lanes<S>) part = select(is_small, part, -most / sqrt(max(square, S(1e-24))));
  const V3<S> friction = hold * part;
  m.most = most;
  // friction that a step lacks comes in the next steps, except in impacts
  constexpr double precision = 0.1, of_weight = 1e-3, of_cone = 0.005, of_impact = 0.001;
  const V3<S> lack = friction - m.across;
  const S limit = S(1 + of_cone) * most;
  const S allowed = select(slot.step.held > law.held, S(of_impact) * most,
                           max(S(precision) * most, S(of_weight) * p.friction * weight));
  const S over_cone = dot(m.across, m.across) - limit * limit;
  const S outside = search < Search::yields ? max(dot(lack, lack) - allowed * allowed, over_cone) : over_cone;
  m.is_off_cone = is_on & !m.is_drawn & (outside > zero);
  m.turns_back = S(1) < S(0);
  if (slot.step.slides) m.turns_back = m.is_off_cone & (dot(slot.step.slide, hold) < zero);
  m.pushes_now = S(1) < S(0);
  if (search < Search::yields) m.pushes_now = (!is_on) & (slot.rests > zero);
  if (lane::any(m.pushes_now)) {
    const S speed = dot(o.velocity, p.normal);
    m.pushes_now = m.pushes_now & pushes(p, law, speed, soft_push(p, law, speed));
  }
  m.any = m.is_drawn | m.pushes_now | m.is_off_cone;
  return m;
}

/// Prepares the next trial of a contact.
template <class S>
MURO_INLINE void revise(ContactSlot<S>& slot, const ContactOutcome<S>& o, const Misfit<S>& m, Search search) {
  ContactPoint<S>& p = slot.point;
  const S zero(0), tried_load = p.load;
  // the friction itself takes away the load that is to cause it
  const MaskOf<S> by_friction = m.is_drawn & (p.friction > zero) & (p.load > zero), pulls = m.is_drawn & !by_friction;
  p.is_on = select(pulls, zero, select(m.pushes_now, S(1), p.is_on));
  slot.rests = select(m.pushes_now, zero, slot.rests);
  p.load = select(by_friction, zero, select(m.is_off_cone, likely_load(slot, max(o.load, zero)), p.load));
  p.sticks = select(by_friction | m.is_off_cone, select(m.turns_back, S(1), zero), p.sticks);
  p.slip = select(m.is_off_cone | by_friction, o.slip, p.slip);
  if (search != Search::pieces) {
    constexpr double less = 0.9;
    S drag = min(m.most / sqrt(max(dot(o.slip, o.slip), S(1e-18))), m.held);
    if (search == Search::yields) drag = S(less) * select(p.drags > zero, min(drag, p.drag), drag);
    if (search == Search::ends) drag = zero;
    p.drags = select(m.is_off_cone | by_friction, S(1), p.drags);
    p.drag = select(by_friction, zero, select(m.is_off_cone, drag, p.drag));
  }
  slot.tried_load = select(m.any, tried_load, slot.tried_load);
  slot.found_load = select(m.any, o.load, slot.found_load);
}

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
