// SPDX-License-Identifier: MIT
// Memory of a step of one pack of robots.
#pragma once

#include "batch.hpp"
#include "contact_law.hpp"
#include "joint_law.hpp"
#include "moved_inertias.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

/// Contacts of a pack on the same body, one of each robot. Robots that lack one have a point that does not touch.
template <class S>
struct ContactSlot {
  int body = 0;
  unsigned which = 0;                    ///< lanes that have a contact
  unsigned resists_turning = 0;          ///< lanes whose surface resists turning
  bool has_cells = false;                ///< in some robot, friction acts beside the point
  bool spins = false;                    ///< in some robot, the ends of the cell move about the place of friction
  lane::Places<S, double> kept, wrench;  ///< places of those lanes: for the kept numbers, and for its wrench
  V3<S> velocity;                        ///< m/s: velocity of the point against what it touches; see ContactPoint::turn
  ContactPoint<S> point;
  TurningPoint<S> turning;
  ContactStep<S> step;
  V3<S> axis;                ///< normal in the world, if `has_cells`
  V3<S> way;                 ///< m, world: way of the point since the last step
  V3<S> lever;               ///< m, world: from the body's origin to the point
  bool bears_more = false;   ///< in some robot, it bears more than the robot weighs
  S more;                    ///< ratio of both, at least 1
  S mean_load;               ///< N: mean load of the last steps
  S comes_in;                ///< 1: it is new, or an impact
  S tried_load, found_load;  ///< N: loads of the trial before; -1: there was none
  S rests;                   ///< 1: it is tried without a force, since it had none in the last step
};

/// Response of a body to efforts at some joints alone, while the anchor does not accelerate.
template <class S>
struct Response {
  V3<S> n, f;      ///< wrench that it hands on
  S effort, bias;  ///< N m or N: effort of its joint, and the effort that it lacks if it does not accelerate
};
/// Effort that makes a joint follow its leader: start + per_alpha alpha + per_a a, with the acceleration of the anchor
/// of its group.
template <class S>
struct Following {
  S start;
  V3<S> per_alpha, per_a;
};

/// Returns the rate of the body's joint per rate of its leader.
template <class S>
MURO_INLINE S factor_of(const Structure& s, int k) {
  const Joint& j = s.joints[k];
  return S(j.multiplier * s.bodies[k].sign * s.bodies[j.leader].sign);
}

/// A joint at the start of a step, and its motion in the step.
template <class S>
struct JointStage {
  S q, qd;                      ///< values at the start
  S velocities, accelerations;  ///< means; in a step of several stages, weighted sums
};

/// Returns the acceleration that is kept for the next step, which uses it in its first half; `before`: the one that was
/// kept in the step before. It leads by a third of a step, which takes away most of the energy that an extrapolation
/// adds: a mode that turns by x rad in a step grows by x^4 / 18 instead of x^4 / 4.
template <class S, class T>
MURO_INLINE T trend(const T& now, const T& before) {
  return S(1.5) * now - S(0.5) * before;
}

/// A joint at the end of a step.
template <class S>
struct JointEnd {
  S q, qd;
};

/// Stores numbers. Zeros have no sign: a sign would depend on other robots of the pack, since the terms that only they
/// have are added to all, as zeros.
template <class S, int n>
MURO_INLINE void store_numbers(const lane::Places<S, double>& to, std::ptrdiff_t first, const S (&from)[n],
                               unsigned which) {
  S sums[n];
  for (int i = 0; i < n; ++i) sums[i] = from[i] + S(0);
  lane::store_rows(to, first, sums, which);
}

/// Arrays in the memory that a batch brings.
template <class S>
struct Work {
  BodyStep<S>* bodies;
  OwnLaw<S>* laws;
  JointPiece<S>* pieces;
  S* changes;  ///< changes of the pieces of joints in this step, one per body
  Inertia<S>* slots;
  Inertia<S>* external;        ///< terms on the bodies that have `acts_on`
  Inertia<S>* kept;            ///< inertias that bodies hand on, see Body::kept
  bool* changed;               ///< one per body: whether the next trial differs from the last one
  Folding* folding;            ///< one per body
  const Inertia<S>** acts_on;  ///< one per body: its place in `external`, or null
  V3<S>* drifts;               ///< m/s^2: for bodies with contacts, cross(w, v) and gravity, in their frames
  Response<S>* responses;      ///< one per body
  Following<S>* followings;    ///< one per body
  S* innovations;              ///< for mimic joints of a group, one per body of it, and one row more
  Composite<S>* composites;    ///< as many as `slots`
  JointStage<S>* stages;       ///< one per body
  JointEnd<S>* ends;           ///< one per body
  lane::TwistOf<S>* wrenches;  ///< force and torque, one per body
  ContactSlot<S>* contacts;
  int contact_count = 0;
  Inertia<S> base;  ///< inertia of all bodies, at the base

  MURO_INLINE Work(void* memory, const Structure& s) {
    const int body_count = s.count, slot_count = s.slots;
    char* next = static_cast<char*>(memory);
    const auto take = [&]<class T>(T*& piece, int count) {
      piece = reinterpret_cast<T*>(next);
      next +=
          (sizeof(T) * std::size_t(count) + 63) / 64 * 64;  // NOLINT(bugprone-sizeof-expression): one T is a pointer
    };
    take(bodies, body_count), take(laws, body_count), take(pieces, body_count), take(changes, body_count);
    take(slots, slot_count), take(external, body_count);
    take(kept, body_count), take(changed, body_count), take(folding, body_count), take(acts_on, body_count),
        take(drifts, body_count);
    take(responses, body_count), take(followings, body_count), take(innovations, s.mimic_numbers);
    take(composites, slot_count);
    take(stages, body_count), take(ends, body_count), take(wrenches, body_count);
    contacts = reinterpret_cast<ContactSlot<S>*>(next);
  }
  static std::size_t bytes(int body_count, int slot_count, int mimic_numbers, int contact_count) {
    const auto n = std::size_t(body_count), rounding = std::size_t(25 * 64);
    return n * (sizeof(BodyStep<S>) + sizeof(OwnLaw<S>) + sizeof(JointPiece<S>) + sizeof(S) + 2 * sizeof(Inertia<S>) +
                sizeof(bool) + sizeof(Folding) + sizeof(void*) + sizeof(V3<S>) + sizeof(Following<S>) +
                sizeof(Response<S>) + sizeof(JointStage<S>) + sizeof(JointEnd<S>) + sizeof(lane::TwistOf<S>)) +
           std::size_t(mimic_numbers) * sizeof(S) +
           std::size_t(slot_count) * (sizeof(Inertia<S>) + sizeof(Composite<S>)) +
           std::size_t(contact_count) * sizeof(ContactSlot<S>) + rounding;
  }
};

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
