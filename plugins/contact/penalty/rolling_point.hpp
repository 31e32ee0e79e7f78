// SPDX-License-Identifier: MIT
// Ways of contact points that move over a body, as on a rim that rolls; over a double or SIMD lanes of robots.
#pragma once

#include "patch.hpp"

namespace muro::penalty::law {
inline namespace MURO_ISA {

/// Returns the square (m^2) of the longest way of a point in a step, about the radius of gyration. Farther away, it is
/// a new point.
template <class S>
MURO_INLINE S square_of_reach(const Mobility<S>& body) {
  return body.mass / (S(1.0 / 3) * body.inertia.trace());
}

/// Returns the way (m) of a point in the next step. `way`: in the last step; `before`: in the step before that.
template <class S>
MURO_INLINE V3<S> way_ahead(const V3<S>& way, const V3<S>& before) {
  /// Limit of the relative change of the way from step to step, while the point is one of a smooth rim.
  constexpr double smooth = 0.5;
  /// Part of this change that is added. 0.75 is of second order. More is a little too far ahead, so that rims that roll
  /// fast lose energy instead of gaining it.
  constexpr double bend_ahead = 1.6;
  const V3<S> bend = way - before;
  const auto goes_round = dot(bend, bend) < S(smooth * smooth) * dot(way, way);  // otherwise it jumps
  return select(goes_round, way + S(bend_ahead) * bend, way);
}

}  // namespace MURO_ISA
}  // namespace muro::penalty::law
