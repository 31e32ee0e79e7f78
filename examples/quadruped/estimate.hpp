// SPDX-License-Identifier: MIT
// Velocity of the body and its height above the ground, from the legs that stand and from the accelerometer.
#pragma once

#include <array>
#include <cmath>

#include "../common/vector.hpp"
#include "gait.hpp"

namespace quadruped {

using examples::Vector;

/// Middle of a foot, seen from the body, and velocity of its point of contact relative to the body: m, m/s, along the
/// axes of a level frame with the heading of the body. The velocity is that in a frame that does not turn, so that a
/// foot that neither slips nor lifts has minus the velocity of the body.
struct FootState {
  Vector position, velocity;
};

/// A complementary filter: the accelerometer gives changes, feet that do not slip give the mean. Frame: level, with the
/// heading of the body.
struct BodyState {
  Vector velocity;      ///< m/s
  double ground = 0;    ///< m: z of the plane through the middles of standing feet, seen from the body
  Vector slope;         ///< 1: rise of this plane along x and y; z is 0
  double is_known = 0;  ///< 1 once a foot has stood

  /// `believed`: from 0 to 1, how firmly each foot stands; `acceleration`: without gravity, m/s^2; `turn`: of the
  /// frame, rad/s; `trust`: 1/s, in the legs; `settling`: 1/s, of the ground's height. A foot that would make the body
  /// jump by more than `jump` (m/s) slips or is not at rest yet, and counts less.
  void update(const std::array<FootState, legs>& feet, const std::array<double, legs>& believed,
              const Vector& acceleration, double turn, double trust, double settling, double dt) {
    velocity = velocity + dt * (acceleration - cross(Vector{0, 0, turn}, velocity));
    ground -= velocity.z * dt;
    Vector seen;
    double height = 0, sum = 0, standing = 0;
    for (std::size_t leg = 0; leg < legs; ++leg) {
      const Vector off = -feet[leg].velocity - velocity;
      const double weight = is_known == 0 ? believed[leg] : believed[leg] / (1 + dot(off, off) / (jump * jump));
      seen = seen + weight * off;
      height += believed[leg] * (feet[leg].position.z - ground - dot(slope, feet[leg].position));
      sum += weight, standing += believed[leg];
    }
    if (standing == 0) return;
    const auto share = [&](double rate, double weight) {
      const double part = rate * dt * std::fmin(1, weight);
      return is_known == 0 ? 1 : part / (1 + part);
    };
    if (sum > 0) velocity = velocity + (share(trust, sum) / sum) * seen;
    ground += share(settling, standing) / standing * height;
    is_known = 1;
  }
  /// Updates the slope of the ground by each pair of standing feet in turn (Kaczmarz's method). `rate`: 1/s.
  void incline(const std::array<FootState, legs>& feet, const std::array<double, legs>& believed, double turn,
               double rate, double dt) {
    slope = slope - dt * cross(Vector{0, 0, turn}, slope);
    for (std::size_t i = 0; i < legs; ++i) {
      for (std::size_t j = i + 1; j < legs; ++j) {
        const Vector way = feet[j].position - feet[i].position, along{way.x, way.y, 0};
        const double squared = dot(along, along), part = rate * dt * believed[i] * believed[j];
        if (squared > 0) slope = slope + part * (way.z - dot(slope, along)) / squared * along;
      }
    }
  }

  static constexpr double jump = 0.25;  // m/s
};

}  // namespace quadruped
