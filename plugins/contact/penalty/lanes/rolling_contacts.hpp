// SPDX-License-Identifier: MIT
// Contacts that move over the base of a robot, as on a rim that rolls; over SIMD lanes of robots.
#pragma once

#include "contact_lanes.hpp"
#include "plugins/contact/penalty/rolling_point.hpp"

namespace muro::penalty::law {
namespace {

using lane::load_twist, lane::MaskOf, lane::mask_of, lane::TwistOf;

/// Arm and way of a contact. They are stored apart, so that the points of other robots take few cache lines.
template <class S>
struct ContactArm {
  V3<S> arm;  ///< m, from the base to its place in the middle of the step, when the force acts, as seen from the centre
  V3<S> way;  ///< m: way in the last step, of robots that roll
};

/// What moves the contacts of robots that roll. It is unset if none rolls.
template <class S>
struct RollingContacts {
  MaskOf<S> lanes;  ///< of robots that roll, see KernelRobot
  V3<S> drift;      ///< m: way of the centre of mass within half a step
  S reach2;         ///< m^2: square of the longest way of a point in a step

  /// `base`: m; `h`: s, length of the step.
  [[gnu::noinline]] void find(const ContactLanes<S>& contacts, const Mobility<S>& body, const V3<S>& base, double h) {
    const TwistOf<S> twist = load_twist(contacts.places_of(&KernelRobot::base_twist));
    lanes = mask_of<S>(contacts.rolling);
    drift = (twist.linear + cross(twist.angular, body.centre - base)) * S(0.5 * h);
    reach2 = square_of_reach(body);
  }
  /// Finds the way of a contact and where it will be in the middle of the step. A point that moves over the body, as on
  /// a rim, moves on; other points are new. `way`: from its anchor; `last`: way in the step before; `half_step`: half
  /// the step, in units of the time since the step before.
  MURO_INLINE void move_on(ContactArm<S>& contact, const V3<S>& way, const V3<S>& last, MaskOf<S> have_anchors,
                           S half_step) const {
    const auto moves_on = (dot(way, way) < reach2) & have_anchors & lanes;
    contact.arm = select(moves_on, contact.arm + (way_ahead(way, last) * half_step - drift), contact.arm);
    contact.way = select(moves_on, way, {S(0), S(0), S(0)});
  }
};

}  // namespace
}  // namespace muro::penalty::law
