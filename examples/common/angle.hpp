// SPDX-License-Identifier: MIT
// Angles about the vertical axis: rad, counter-clockwise from x.
#pragma once

#include <cmath>
#include <numbers>
#include <span>

#include "muro_elementary.h"

namespace examples {

/// Returns the same direction within half a turn.
inline double wrapped(double angle) { return std::remainder(angle, 2 * std::numbers::pi); }

/// Returns the yaw of a unit quaternion x, y, z, w.
inline double yaw_of(std::span<const double> q) {
  return muro_atan2(2 * (q[3] * q[2] + q[0] * q[1]), 1 - 2 * (q[1] * q[1] + q[2] * q[2]));
}

}  // namespace examples
