// SPDX-License-Identifier: MIT
// How contact points go on that move over a body, as on a rim that rolls; over a double or SIMD lanes of robots.
#pragma once

#include "patch.hpp"

namespace muro::penalty::law {
inline namespace MURO_ISA {

/// m^2: the square of how far a point goes in a step at most, about the radius of gyration; beyond it, it is a new one.
template <class S>
MURO_INLINE S square_of_reach(const Mobility<S>& body) {
  return body.mass / (S(1.0 / 3) * body.inertia.trace());
}

/// m: what a point goes in the next step, that went `way` in the last one and `before` in the one before.
template <class S>
MURO_INLINE V3<S> way_ahead(const V3<S>& way, const V3<S>& before) {
  /// By so much of itself the way changes from step to step, as long as the point is one of a smooth rim.
  constexpr double smooth = 0.5;
  /// So much of this change is added. 0.75 is of second order; more is a little too far ahead, so that rims that roll
  /// fast lose energy instead of gaining it.
  constexpr double bend_ahead = 1.6;
  const V3<S> bend = way - before;
  const auto goes_round = dot(bend, bend) < S(smooth * smooth) * dot(way, way);  // else it jumps
  return select(goes_round, way + S(bend_ahead) * bend, way);
}

}  // namespace MURO_ISA
}  // namespace muro::penalty::law
