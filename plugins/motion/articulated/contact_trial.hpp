// SPDX-License-Identifier: MIT
// Contacts of a step are solved by trial: each is tried as it was in the last step, and where that is not what comes of
// it, with what comes next.
#pragma once

#include "work.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

/// What a contact does after a trial; in the frame of the body.
template <class S>
struct ContactOutcome {
  V3<S> force;     ///< N
  S load;          ///< N: along the normal
  V3<S> velocity;  ///< m/s: of the point against what it touches, at the end of the step
  V3<S> slip;      ///< m/s: the same across the normal
};

/// N: the load that friction with this load leads to, as far as two trials tell (the secant method).
template <class S>
MURO_INLINE S likely_load(const ContactSlot<S>& slot, S found) {
  const S change = slot.point.load - slot.tried_load, slope = (found - slot.found_load) / change;
  const S meet = (found - slope * slot.point.load) / (S(1) - slope);
  const auto tells = (slot.found_load >= S(0)) & (change * change > S(0)) & (slope < S(0.5));
  return select(tells, max(meet, S(0)), found);
}

/// Prepares the next trial of a contact that pulls, which is let go then, that was let go and would push, that slides
/// and would turn back, that sticks and has to hold more than it can, or that is new and bears another load than was
/// expected. `weight`: N, of the robot. Returns a bit for each robot where it is one of these.
template <class S>
MURO_INLINE unsigned revise(ContactSlot<S>& slot, const ContactOutcome<S>& o, const ContactLaw<S>& law, S weight) {
  ContactPoint<S>& p = slot.point;
  const S zero(0), load = o.load;
  const MaskOf<S> is_on = p.is_on > zero, is_drawn = is_on & (load < zero), has_friction = p.friction > zero,
                  drags = p.breaks_away > zero, none = S(1) < zero;
  // friction that a load is to bear which it takes away itself
  const MaskOf<S> by_friction = is_drawn & has_friction & (p.load > zero), pulls = is_drawn & !by_friction;
  const S precision = select(slot.is_new > zero, S(0.1), S(0.25));
  const MaskOf<S> bears_other = is_on & !pulls & has_friction & !drags &
                                (lane::abs(load - p.load) > precision * max(load, p.load) + S(0.05) * weight);
  MaskOf<S> turns_back = none;
  if (slot.step.slides) turns_back = dot(slot.step.slide, o.velocity) < zero;
  // more than friction can hold, or a damper that does something else than it by now
  const V3<S> across = o.force - load * p.normal;
  const S most = p.friction * max(load, zero), expected = p.friction * p.load, margin(1.1 * 1.1);
  const MaskOf<S> pushes_on = is_on & !is_drawn;
  const MaskOf<S> breaks_away =
      pushes_on & !turns_back & !drags & (dot(across, across) > margin * max(most * most, expected * expected));
  MaskOf<S> drags_other = none;
  if (lane::any(breaks_away | drags)) {
    const S speed = sqrt(dot(o.slip, o.slip)), drag = p.drag * speed;
    drags_other = pushes_on & drags & (lane::abs(drag - most) > S(0.1) * max(drag, most));
    p.drag = select(breaks_away | drags_other, most / max(speed, S(1e-9)), p.drag);
    p.breaks_away = select(breaks_away, S(1), p.breaks_away);
  }
  MaskOf<S> pushes_now = (!is_on) & (slot.rests > zero);
  if (lane::any(pushes_now)) {
    const S speed = dot(o.velocity, p.normal);
    pushes_now = pushes_now & pushes(p, law, speed, soft_push(p, law, speed));
    slot.rests = select(pushes_now, zero, slot.rests);
  }
  const unsigned changed =
      lane::bits(MaskOf<S>(is_drawn | pushes_now | bears_other | turns_back | breaks_away | drags_other));
  const S tried_load = p.load;
  if (changed != 0) {
    p.is_on = select(pulls, zero, select(pushes_now, S(1), p.is_on));
    p.slides_on = select(turns_back, zero, p.slides_on);
    const S next = likely_load(slot, load);
    p.load = select(by_friction, zero, select(bears_other, next, p.load));
    p.drag = select(by_friction, zero, p.drag);
  }
  slot.tried_load = tried_load, slot.found_load = load;
  return changed;
}

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
