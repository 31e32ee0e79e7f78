// SPDX-License-Identifier: MIT
// The linear inverted pendulum (Kajita et al., IROS 2001) and its divergent component of motion (Takenaka et al., IROS
// 2009), which is the capture point (Pratt et al., Humanoids 2006), along one axis of the ground:
//
//     x'' = w^2 (x - p),   w = sqrt(g / z),   xi = x + x' / w,   xi' = w (xi - p)
//
// with x the centre of mass, p the point about which it falls (the ZMP), z the constant height of the mass.
#pragma once

#include "muro_elementary.h"

namespace walking {

inline constexpr double gravity = 9.81;  // m/s^2

struct Pendulum {
  double position = 0, velocity = 0;  ///< m, m/s

  double capture_point(double w) const { return position + velocity / w; }
  /// Returns the state after `t` s about the point `p`.
  Pendulum after(double t, double p, double w) const {
    const double c = muro_cosh(w * t), s = muro_sinh(w * t);
    return {p + (position - p) * c + velocity / w * s, (position - p) * w * s + velocity * c};
  }
};

/// Returns the capture point `t` s later about `p`.
inline double capture_point_after(double xi, double t, double p, double w) { return p + (xi - p) * muro_exp(w * t); }

/// Returns how far the capture point is ahead of a foot that begins to carry. Each step of the walk takes `t` s, and
/// feet are put down by `next` and `after` m from each other in turns. In a periodic walk, with xi - foot = a or b in
/// turns, a e^(w t) = next + b and b e^(w t) = after + a.
inline double capture_point_offset(double next, double after, double t, double w) {
  const double growth = muro_exp(w * t);
  return (next * growth + after) / (growth * growth - 1);
}

}  // namespace walking
