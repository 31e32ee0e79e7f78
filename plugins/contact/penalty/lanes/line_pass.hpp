// SPDX-License-Identifier: MIT
// Motion and forces of contacts that are lines and points, in one pass.
#pragma once

#include "contact_passes.hpp"

namespace muro::penalty::law {
namespace {

template <class S>
MURO_INLINE void RobotContacts<S>::push_lines(S load) {
  const S none(0);
  V3<S> force{none, none, none}, torque = force;
  const FrictionLaw<S> friction(batch_.stiffness, load);
  NormalLaw<S> law(batch_.stiffness, lanes_.of_contacts(0, zeta_of), load);
  ContactRun<S> run;
  for (run.begin = 0; run.begin < lanes_.most; run.begin = run.end) {
    run.find_end_and_bodies(lanes_);
    run.find_anchors(lanes_);
    if (run.most_anchors <= 1)
      push_line<1>(run, friction, law, load, force, torque);
    else if (run.most_anchors == 2)
      push_line<2>(run, friction, law, load, force, torque);
    else
      push_any_line(run, friction, law, load, force, torque);
  }
  store_wrench(force, torque, lanes_.used);
}

template <class S>
[[gnu::noinline]] void RobotContacts<S>::push_any_line(const ContactRun<S>& run, const FrictionLaw<S>& friction,
                                                       NormalLaw<S>& law, S load, V3<S>& force, V3<S>& torque) {
  push_line<max_contacts>(run, friction, law, load, force, torque);
}

template <class S>
template <int n>
MURO_INLINE void RobotContacts<S>::push_line(const ContactRun<S>& run, const FrictionLaw<S>& friction,
                                             NormalLaw<S>& law, S load, V3<S>& force, V3<S>& torque) {
  const V3<S> origin = load_vector(run.poses);
  const TwistOf<S> body = load_twist(run.twists);
  OldAnchors<S, n> before;
  run.load_anchors(lanes_, before);
  const int k = run.begin;
  const ContactPoint<S>* const points = contacts_.points;
  const auto find_displacement = [&](int i, ContactMotion<S>& motion) __attribute__((always_inline)) {
    const V3<S> none{S(0), S(0), S(0)};
    V3<S> old = none, way = none;
    if (run.most_anchors > 0) old = before.nearest(points[i].at, run.most_anchors, way);
    if (!run.all_have_anchors) old = select(run.have_anchors(), old, none);
    motion.find_displacement(points[i].normal, old, S(batch_.elapsed));
  };
  ContactMotion<S> a, b;
  a.find_slip(points[k], body, origin);
  if (run.end == k + 1) {
    find_displacement(k, a);
    const ContactForce<S> f = force_of<Cells::lines>(k, a, false, friction, law, load, lanes_.used);
    return add<Cells::lines>(k, f.along + f.across, force, torque);
  }
  b.find_slip(points[k + 1], body, origin);
  const V3<S> part = part_of_line(a.slip, b.slip);
  a.slip += part, b.slip -= part;
  a.spin = b.spin = speed_of_ends(part);
  find_displacement(k, a);
  find_displacement(k + 1, b);
  const bool spins = any(a.spin > S(0));
  const ContactForce<S> first = force_of<Cells::lines>(k, a, spins, friction, law, load, lanes_.used);
  const ContactForce<S> second = force_of<Cells::lines>(k + 1, b, spins, friction, law, load, lanes_.used);
  const V3<S> moved = part_of_line(first.across, second.across);
  add<Cells::lines>(k, first.along + (first.across + moved), force, torque);
  add<Cells::lines>(k + 1, second.along + (second.across - moved), force, torque);
}

}  // namespace
}  // namespace muro::penalty::law
