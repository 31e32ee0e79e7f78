// SPDX-License-Identifier: MIT
// Attitude as three angles.
#pragma once

#include <cmath>

#include "../common/vector.hpp"
#include "muro_elementary.h"

namespace quadruped {

using examples::Rotation;

/// Angles about the fixed axes x, y, z in this order (REP-103), rad.
struct Angles {
  double roll = 0, pitch = 0, yaw = 0;

  static Angles of(const Rotation& r) {
    const double sine = std::fmin(1, std::fmax(-1, -r.x.z));
    return {muro_atan2(r.y.z, r.z.z), muro_asin(sine), muro_atan2(r.x.y, r.x.x)};
  }
};

}  // namespace quadruped
