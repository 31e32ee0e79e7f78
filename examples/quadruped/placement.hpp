// SPDX-License-Identifier: MIT
// Way of a swinging foot, and its place on the ground by Raibert's rule.
#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

#include "../common/vector.hpp"
#include "gait.hpp"
#include "muro_elementary.h"

namespace quadruped {

using examples::Vector;

/// Commanded motion in a level frame with the heading of the robot: m/s, m/s, rad/s.
struct Command {
  double forward = 0, left = 0, turn = 0;
};

struct Placement {
  double gain = 0.05;      ///< s: shift of a foot outwards for each m/s that the robot is too fast
  double farthest = 0.15;  ///< m, greatest distance of the foot from the projection of its hip
  double height = 0.3;     ///< m, of the body
  double gravity = 9.81;   ///< m/s^2

  /// Returns the middle of the foot at touchdown, seen from the body, level and with its heading; z is 0:
  ///     hip + v T / 2 + k (v - v_wanted) + h / (2 g) v x w   with the hip turned by w T / 2, T the time of stance
  /// (Raibert, Legged Robots that Balance, 1986; the term for curves: Kim et al., arXiv 1909.06586).
  Vector target(const Vector& foot_below_hip, const Vector& velocity, const Command& wanted, double stance_time) const {
    const double angle = 0.5 * wanted.turn * stance_time, c = muro_cos(angle), s = muro_sin(angle);
    const Vector& hip = foot_below_hip;
    const double curve = 0.5 * height / gravity * wanted.turn;
    double x = c * hip.x - s * hip.y - hip.x, y = s * hip.x + c * hip.y - hip.y;
    x += 0.5 * stance_time * velocity.x + gain * (velocity.x - wanted.forward) + curve * velocity.y;
    y += 0.5 * stance_time * velocity.y + gain * (velocity.y - wanted.left) - curve * velocity.x;
    const double away = muro_hypot(x, y), shorter = away > farthest ? farthest / away : 1;
    return {hip.x + shorter * x, hip.y + shorter * y, 0};
  }
};

/// A point and its velocity, m and m/s.
struct Motion {
  Vector position, velocity;
};

/// Way of a foot in the air, seen from the body. Along the ground it is a cubic that begins and ends with the speed of
/// the ground, so the foot is dragged neither when it lifts nor when it lands. Upwards it is the square of a sine.
struct Arc {
  Vector from;            ///< m: where it was lifted
  double lift = 0.06;     ///< m, above the straight line between both ends
  double duration = 0.2;  ///< s

  /// `progress` from 0 to 1; `to` in m; `ground`: velocity of the ground, m/s.
  Motion at(double progress, const Vector& to, const Vector& ground) const {
    const double t = std::clamp(progress, 0.0, 1.0), pi = std::numbers::pi;
    const double h = t * t * (3 - 2 * t), dh = 6 * t * (1 - t);
    const double g = t * (1 - t) * (1 - 2 * t), dg = 1 - 6 * t + 6 * t * t;  // both ends have the slope 1
    const Vector way = to - from;
    const double sine = muro_sin(pi * t), rise = lift * sine * sine, up = lift * pi * muro_sin(2 * pi * t);
    Motion m;
    m.position = from + h * way + (g * duration) * ground + Vector{0, 0, rise};
    m.velocity = (dh / duration) * way + dg * ground + Vector{0, 0, up / duration};
    return m;
  }
};

}  // namespace quadruped
