// SPDX-License-Identifier: MIT
// Passes over the contacts of robots: motion of all contacts, then their forces.
#pragma once

#include "robot_contacts.hpp"

namespace muro::penalty::law {
namespace {

template <class S>
template <Cells cells>
MURO_INLINE unsigned RobotContacts<S>::move_contacts() {
  S may_collide(0);  // 0 or 1
  if constexpr (cells == Cells::any)
    if (cells_.has_cells) find_any_slips();
  ContactRun<S> run;
  for (run.begin = 0; run.begin < lanes_.most; run.begin = run.end) {
    run.find_end_and_bodies(lanes_);
    run.find_anchors(lanes_);
    if (run.most_anchors == 1)  // spherical wheels and feet
      move_run<1, cells>(run, may_collide);
    else if (run.most_anchors == 2)  // cylindrical wheels and tracks
      move_run<2, cells>(run, may_collide);
    else
      move_any_run<cells>(run, may_collide);
  }
  if constexpr (cells != Cells::none) any_spins_ = any(largest_spin_ > S(0));
  return bits(may_collide > S(0));
}

template <class S>
[[gnu::noinline]] void RobotContacts<S>::find_any_slips() {
  ContactRun<S> run;
  for (run.begin = 0; run.begin < lanes_.most; run.begin = run.end) {
    run.find_end_and_bodies(lanes_);
    const V3<S> origin = load_vector(run.poses);
    const TwistOf<S> body = load_twist(run.twists);
    for (int k = run.begin; k < run.end; ++k) {
      motions_[k].find_slip(contacts_.points[k], body, origin);
      cells_.move_slip_in_face(contacts_, k, body.angular, motions_[k]);
    }
  }
  for (int k = 0; k < lanes_.most; ++k) {
    cells_.move_slips_of_line(k, motions_);
    largest_spin_ = max(motions_[k].spin, largest_spin_);
  }
}

template <class S>
template <Cells cells>
[[gnu::noinline]] void RobotContacts<S>::move_any_run(const ContactRun<S>& run, S& may_collide) {
  move_run<max_contacts, cells>(run, may_collide);
}

template <class S>
template <int n, Cells cells>
MURO_INLINE void RobotContacts<S>::move_run(const ContactRun<S>& run, S& may_collide) {
  const V3<S> origin = load_vector(run.poses);
  const TwistOf<S> body = load_twist(run.twists);
  const int anchors = n < max_contacts ? n : run.most_anchors;
  OldAnchors<S, n> before;
  run.load_anchors(lanes_, before);
  const S zero(0), elapsed(batch_.elapsed), impact_speed(batch_.impact_speed);
  const S half_step(batch_.elapsed > 0 ? 0.5 * batch_.stiffness.h / batch_.elapsed : 0);
  const V3<S> none{zero, zero, zero};
  const MaskOf<S> have_anchors = run.have_anchors();
  for (int k = run.begin; k < run.end; ++k) {
    const ContactPoint<S>& p = contacts_.points[k];
    ContactMotion<S>& motion = motions_[k];
    if (cells == Cells::none || (cells == Cells::any && !cells_.has_cells)) motion.find_slip(p, body, origin);
    V3<S> old = none, way = none;
    if (anchors > 0) old = before.nearest(p.at, anchors, way);
    if (!run.all_have_anchors) old = select(have_anchors, old, none);
    if constexpr (cells == Cells::any) arms_[k].arm = p.at - base_;
    if (cells == Cells::any && lanes_.rolling != 0)
      rolling_.move_on(arms_[k], way, anchors > 0 ? before.way_of_nearest(p.at, anchors) : none, have_anchors,
                       half_step);
    motion.find_displacement(p.normal, old, elapsed);
    if (!any_looked_at_) continue;
    const auto fast = (motion.approach > impact_speed) & looked_at_ & (p.patch >= zero);
    if (!any(fast)) continue;
    const S reach = S(lasting_reach) + S(lasting_slips) * elapsed * sqrt(dot(motion.slip, motion.slip));
    const S distance2 = anchors > 0 ? before.least_distance2(p.at, anchors) : zero;
    const auto lasts = have_anchors & (distance2 < reach * reach);
    may_collide = select(fast, select(lasts, may_collide, S(1)), may_collide);
  }
}

template <class S>
template <Cells cells>
MURO_INLINE void RobotContacts<S>::add_forces(S load, unsigned processed) {
  const S none(0);
  V3<S> force{none, none, none}, torque = force;
  const FrictionLaw<S> friction(batch_.stiffness, load);
  NormalLaw<S> law(batch_.stiffness, lanes_.of_contacts(0, zeta_of), load);
  if constexpr (cells == Cells::none) {
    for (int k = 0; k < lanes_.most; ++k) {
      const ContactForce<S> f = force_of<cells>(k, motions_[k], false, friction, law, load, processed);
      add<cells>(k, f.along + f.across, force, torque);
    }
  } else {
    ContactForce<S> forces[max_contacts];
    for (int k = 0; k < lanes_.most; ++k)
      forces[k] = force_of<cells>(k, motions_[k], any_spins_, friction, law, load, processed);
    if (cells_.has_cells) cells_.move_friction(contacts_, lanes_.most, forces, torque);
    for (int k = 0; k < lanes_.most; ++k) add<cells>(k, forces[k].along + forces[k].across, force, torque);
  }
  store_wrench(force, torque, processed);
}

template <class S>
template <Cells cells>
MURO_INLINE ContactForce<S> RobotContacts<S>::force_of(int k, const ContactMotion<S>& motion, bool spins,
                                                       const FrictionLaw<S>& friction, NormalLaw<S>& law, S load,
                                                       unsigned which) {
  const S none(0);
  if (lanes_.has_many_materials) law = {batch_.stiffness, lanes_.of_contacts(k, zeta_of), load};
  const ContactPoint<S>& p = contacts_.points[k];
  EffectiveMass<S> mass;
  contacts_.find_mass(k, mass);
  V3<S> displacement = motion.displacement;
  const S normal = mass.along * law.force(p.depth, motion.approach);
  const S most = p.friction * normal * mass.inverse_across;
  ContactForce<S> force;
  force.along = normal * p.normal;
  if (cells != Cells::none && spins)
    force.across = mass.across * friction.force(displacement, motion.slip, most, motion.spin);
  else
    force.across = mass.across * friction.force(displacement, motion.slip, most);
  if (cells != Cells::lines && k >= lanes_.least) {
    const auto here = S(k) < lanes_.count;
    force = {select(here, force.along, {none, none, none}), select(here, force.across, {none, none, none})};
    which &= bits(here);
  }
  if (lanes_.rolling != 0) lanes_.store_way(k, arms_[k].way, which & lanes_.rolling);
  lanes_.store_anchor(k, p.at, displacement, which);
  if (batch_.tells_contacts) tell_contact<cells>(k, force, which);
  return force;
}

template <class S>
template <Cells cells>
MURO_INLINE void RobotContacts<S>::tell_contact(int k, const ContactForce<S>& of_contact, unsigned which) const {
  V3<S> torque{S(0), S(0), S(0)};
  if constexpr (cells == Cells::lines) {
    const int other = lanes_.is_joined(k) ? k - 1 : lanes_.is_joined(k + 1) ? k + 1 : k;
    if (other != k) torque = cross(part_of_line(contacts_.points[k].at, contacts_.points[other].at), of_contact.across);
  }
  if (cells == Cells::any && cells_.has_cells) cells_.find_moment(contacts_, k, of_contact.across, torque);
  const V3<S> force = of_contact.along + of_contact.across;
  store_rows(lanes_.forces, k * force_stride, {force.x, force.y, force.z, torque.x, torque.y, torque.z}, which);
}

}  // namespace
}  // namespace muro::penalty::law
