// SPDX-License-Identifier: MIT
// Two bones with a hinge between them, such as thigh and shin.
#pragma once

#include <algorithm>

#include "muro_elementary.h"

namespace examples {

/// Lengths of the bones, m.
struct TwoBones {
  double upper = 0, lower = 0;

  /// Returns the angle of the hinge, rad, from 0 (straight) to pi. `squared`: square of the distance between both ends,
  /// m^2. A distance that is too long or too short gives the nearest angle.
  double bend_for(double squared) const {
    const double cosine = (squared - upper * upper - lower * lower) / (2 * upper * lower);
    return muro_acos(std::clamp(cosine, -1.0, 1.0));
  }
  /// Returns the angle between the upper bone and the line through both ends, rad, with the hinge at `bend`.
  double lead(double bend) const { return muro_atan2(lower * muro_sin(bend), upper + lower * muro_cos(bend)); }
};

}  // namespace examples
