// SPDX-License-Identifier: MIT
// What a step keeps of each body of a pack of robots, and how vectors pass between a body and its parent.
#pragma once

#include "muro/simd/rows.hpp"
#include "spatial.hpp"
#include "structure.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

using lane::M3, lane::splat, lane::V3;

/// How a joint moves in a step: qdd = rate + is_free (effort - what the bodies behind it need) / inertia. One per
/// joint.
template <class S>
struct JointTerms {
  S effort;   ///< N m or N
  S inertia;  ///< kg m^2 or kg, beside that of the bodies: armature, and what drives and dampers do implicitly
  S rate;     ///< rad/s^2 or m/s^2: of a held joint, else 0
  S is_free;  ///< 1, or 0: held
};

/// What a step keeps of each body and its joint.
template <class S>
struct BodyStep {
  Turn<S> turn;    ///< of a hinge
  S q, qd;         ///< rad or m, rad/s or m/s, in the direction of the body's axis
  V3<S> w, v;      ///< angular and linear velocity
  V3<S> Un, Uf;    ///< inertia times the joint's direction
  S D;             ///< inertia that the joint moves, with its own terms
  S give;          ///< how the joint gives way: 1 / D, or 0 where it is held
  S bias;          ///< effort that it lacks when it does not accelerate
  S needed;        ///< the same with the acceleration of its parent
  S qdd;           ///< acceleration of the joint
  V3<S> alpha, a;  ///< acceleration
  M3<S> axes;      ///< of the frame in the world
  V3<S> origin;    ///< m, in the world
  JointTerms<S> terms;
};

/// Masses of as many robots as S has values: each has its own, or all have the same.
template <class S>
struct Masses {
  lane::Places<S> at;  ///< Mass of body 0
  bool are_equal = true;

  MURO_INLINE void load(int body, S (&to)[Mass::numbers]) const {
    const std::ptrdiff_t first = std::ptrdiff_t(body) * Mass::numbers;
    if (are_equal)
      for (int k = 0; k < Mass::numbers; ++k) to[k] = S(at.at[0][first + k]);
    else
      lane::load_rows(at, first, to);
  }
};

// A body is `plain` whose joint is a hinge and that is parallel to its parent at joint position 0, as most are.

template <bool plain, class S>
MURO_INLINE V3<S> offset_of(const Body& b, S q) {
  V3<S> o = splat<S>(b.offset);
  if (!plain && b.slides) o += splat<S>(b.turn + 3 * b.axis) * q;
  return o;
}
template <class S>
MURO_INLINE M3<S> turn_of(const Body& b) {
  return {splat<S>(b.turn), splat<S>(b.turn + 3), splat<S>(b.turn + 6)};
}

/// A spatial vector (angular w, linear v) of the parent in the frame of a body.
template <int K, bool plain, class S>
MURO_INLINE void into_body(const Body& b, const BodyStep<S>& own, V3<S>& w, V3<S>& v) {
  if (b.shifted || (!plain && b.slides)) v += cross(w, offset_of<plain>(b, own.q));
  if (!plain && b.turned) w = into(turn_of<S>(b), w), v = into(turn_of<S>(b), v);
  if (plain || !b.slides) w = into<K>(own.turn, w), v = into<K>(own.turn, v);
}

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
