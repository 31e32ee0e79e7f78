// SPDX-License-Identifier: MIT
// State of each body of a pack of robots within a step, and change of vectors between body and parent.
#pragma once

#include "muro/simd/rows.hpp"
#include "spatial.hpp"
#include "structure.hpp"

namespace muro::articulated::lanes {
inline namespace MURO_ISA {

using lane::M3, lane::splat, lane::V3;

/// Terms of the motion of a joint in a step: qdd = rate + is_free (effort - effort that the bodies behind it need) /
/// inertia. There is one per joint.
template <class S>
struct JointTerms {
  S effort;   ///< N m or N
  S inertia;  ///< kg m^2 or kg, beside the bodies: armature, and the implicit terms of drives and dampers
  S rate;     ///< rad/s^2 or m/s^2: acceleration of a held joint, else 0
  S is_free;  ///< 1; 0: the joint is held
};

/// State of a body and its joint within a step.
template <class S>
struct BodyStep {
  Turn<S> turn;    ///< rotation by the joint, if that is a hinge
  S q, qd;         ///< rad or m, rad/s or m/s, in the direction of the body's axis
  V3<S> w, v;      ///< angular and linear velocity
  V3<S> Un, Uf;    ///< inertia times the joint's direction
  S D;             ///< inertia that the joint moves, with the joint's own terms
  S give;          ///< mobility of the joint: 1 / D, or 0 when it is held
  S bias;          ///< effort that the joint lacks if it does not accelerate
  S needed;        ///< the same if the parent accelerates as it does
  S qdd;           ///< acceleration of the joint
  V3<S> alpha, a;  ///< acceleration
  M3<S> axes;      ///< axes of the frame in the world
  V3<S> origin;    ///< m, in the world
  JointTerms<S> terms;
};

/// Masses of as many robots as S has values. Each robot has its own, or all have the same.
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

// Most bodies are `plain`: the joint is a hinge, and at joint position 0 the body is parallel to its parent.

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

/// Changes a spatial vector (angular w, linear v) from the frame of the parent to that of a body.
template <int K, bool plain, class S>
MURO_INLINE void into_body(const Body& b, const BodyStep<S>& own, V3<S>& w, V3<S>& v) {
  if (b.shifted || (!plain && b.slides)) v += cross(w, offset_of<plain>(b, own.q));
  if (!plain && b.turned) w = into(turn_of<S>(b), w), v = into(turn_of<S>(b), v);
  if (plain || !b.slides) w = into<K>(own.turn, w), v = into<K>(own.turn, v);
}

}  // namespace MURO_ISA
}  // namespace muro::articulated::lanes
