// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "muro/base/elementary.hpp"

namespace muro::penalty {

/// Returns the coefficient of restitution of a linear spring-damper that never pulls, for the damping ratio `zeta`
/// (Schwager and Poeschel, Coefficient of restitution and linear-dashpot model revisited, Granular Matter 9, 2007,
/// their three cases in one: ln e = -2 zeta acos(zeta) / sqrt(1 - zeta^2)).
inline double restitution_of(double zeta) {
  const double rest = 1 - zeta * zeta;
  if (std::abs(rest) < 1e-8) return elementary::exp(-2.0);
  const double angle = rest > 0 ? elementary::acos(zeta) : elementary::acosh(zeta);
  return elementary::exp(-2 * zeta * angle / std::sqrt(std::abs(rest)));
}

/// Critical damping, e = 0.135. More damping would make a contact sluggish and require shorter steps.
inline constexpr double max_damping_ratio = 1;

/// Returns the damping ratio for a coefficient of restitution from 0 to 1. Bisection is slow, so call it once a
/// material.
inline double damping_ratio_of(double restitution) {
  double low = 0, high = max_damping_ratio;
  if (restitution <= restitution_of(high)) return high;
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (low + high);
    (restitution_of(middle) > restitution ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

}  // namespace muro::penalty
