// SPDX-License-Identifier: MIT
// Wanted places of soles and centre of mass at one instant, for a walk or a kick.
//
// Everything is in a frame on the ground that begins where the robot stands: x forward, y left.
#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "muro_elementary.h"
#include "pendulum.hpp"

namespace walking {

struct Foothold {
  double x = 0, y = 0, yaw = 0;

  /// Returns the place that is `ahead` and `left` (m) of this one, turned by `turn` (rad).
  Foothold beside(double ahead, double left, double turn = 0) const {
    double s, c;
    muro_sincos(yaw, &s, &c);
    return {x + c * ahead - s * left, y + s * ahead + c * left, yaw + turn};
  }
};

enum Side : std::int64_t { left_side, right_side };
inline Side other(Side side) { return side == left_side ? right_side : left_side; }

/// Rises from 0 to 1 for t from 0 to 1, with speed and acceleration 0 at both ends.
inline double smooth(double t) { return t * t * t * (10 + t * (6 * t - 15)); }

/// A sole above the ground.
struct SolePlace {
  Foothold at;
  double height = 0;
};

struct Reference {
  Pendulum x, y;                                  ///< centre of mass
  double acceleration_x = 0, acceleration_y = 0;  ///< m/s^2, of the centre of mass
  double yaw = 0;                                 ///< yaw of the trunk
  std::array<SolePlace, 2> soles;                 ///< left, right
  double left_share = 0.5;                        ///< share of the weight on the left foot
  Side stance = left_side;                        ///< foot that carries if only one does
  std::int64_t both = 1;                          ///< both feet are on the ground; no bool: padding would be saved

  bool carries(Side side) const { return both != 0 || side == stance; }
};

/// Returns the share of the weight on the left foot, with the ZMP at this place and both feet on the ground.
inline double share_of_left(double zmp_x, double zmp_y, const Foothold& left, const Foothold& right) {
  const double dx = left.x - right.x, dy = left.y - right.y;
  return std::clamp(((zmp_x - right.x) * dx + (zmp_y - right.y) * dy) / (dx * dx + dy * dy), 0.0, 1.0);
}

}  // namespace walking
