// SPDX-License-Identifier: MIT
// How fast the body moves and how high it is above the ground, by the legs that stand and by the accelerometer.
#pragma once

#include <array>

#include "gait.hpp"
#include "vector.hpp"

namespace quadruped {

/// Where the middle of a foot is, seen from the body, and how fast the point where it touches the ground moves away
/// from it: m, m/s, along the axes of a level frame with the heading of the body. The velocity is that in a frame that
/// does not turn, so that a foot that neither slips nor lifts has minus the velocity of the body.
struct FootState {
  Vector position, velocity;
};

/// A complementary filter: the accelerometer tells changes, a foot that does not slip the mean. Frame: level, with the
/// heading of the body.
struct BodyState {
  Vector velocity;      ///< m/s
  double ground = 0;    ///< m: middle of the feet that stand, along z, seen from the body
  double is_known = 0;  ///< 1 once a foot has stood

  /// `acceleration`: without gravity, m/s^2; `turn`: of the frame, rad/s; `trust`: 1/s, in the legs; `settling`: 1/s,
  /// of the ground's height.
  void update(const std::array<FootState, legs>& feet, const std::array<bool, legs>& stands, const Vector& acceleration,
              double turn, double trust, double settling, double dt) {
    velocity = velocity + dt * (acceleration - cross(Vector{0, 0, turn}, velocity));
    Vector seen;
    double height = 0, count = 0;
    for (std::size_t leg = 0; leg < legs; ++leg) {
      if (!stands[leg]) continue;
      seen = seen - feet[leg].velocity;
      height += feet[leg].position.z;
      count += 1;
    }
    ground -= velocity.z * dt;
    if (count == 0) return;
    const double share = is_known == 0 ? 1 : trust * dt / (1 + trust * dt);
    const double settled = is_known == 0 ? 1 : settling * dt / (1 + settling * dt);
    velocity = velocity + share * ((1 / count) * seen - velocity);
    ground += settled * (height / count - ground);
    is_known = 1;
  }
};

}  // namespace quadruped
