// SPDX-License-Identifier: MIT
// Forces of the standing feet with which the body keeps its height, its attitude and its speed.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>

#include "../common/vector.hpp"
#include "gait.hpp"
#include "muro_elementary.h"

namespace quadruped {

using examples::Vector;

/// Wrench of the feet on the body, level frame: N and, about the centre of mass, N m.
struct BodyWrench {
  Vector force, torque;
};

/// Shares a wrench among feet that push and do not pull. The forces f_i minimise
/// |sum f_i - F|^2 + |sum r_i x f_i - T|^2 / l^2, each row by its weight, + |f|^2
/// (Focchi et al., Autonomous Robots 41, 2017, without the constraints). Then they are cut to the cone of friction.
struct ForceDistribution {
  double length = 0.2;           ///< m: a torque T counts as much as a force T / length
  double friction = 0.5;         ///< 1, friction of the feet
  double least = 5, most = 300;  ///< N, limits for a foot along z

  /// Share of each component of the wrench that may stay open when the feet cannot produce all of them: forces of two
  /// feet cannot turn the body about the line through both.
  std::array<double, 6> slack{0.05, 0.05, 1e-4, 1e-3, 1e-3, 0.02};

  /// Returns forces, N. `stands`: which feet stand; `arms`: from the centre of mass to each foot, m, level frame.
  std::array<Vector, legs> share(const BodyWrench& wanted, const std::array<bool, legs>& stands,
                                 const std::array<Vector, legs>& arms) const;
};

namespace detail {

/// Solves m x = b for a symmetric positive definite m, by Cholesky's method; x replaces b.
inline void solve(std::array<std::array<double, 6>, 6>& m, std::array<double, 6>& b) {
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t j = 0; j <= i; ++j) {
      double sum = m[i][j];
      for (std::size_t k = 0; k < j; ++k) sum -= m[i][k] * m[j][k];
      m[i][j] = i == j ? std::sqrt(sum) : sum / m[j][j];
    }
  }
  for (std::size_t i = 0; i < 6; ++i) {
    for (std::size_t k = 0; k < i; ++k) b[i] -= m[i][k] * b[k];
    b[i] /= m[i][i];
  }
  for (std::size_t i = 6; i-- > 0;) {
    for (std::size_t k = i + 1; k < 6; ++k) b[i] -= m[k][i] * b[k];
    b[i] /= m[i][i];
  }
}

}  // namespace detail

inline std::array<Vector, legs> ForceDistribution::share(const BodyWrench& wanted, const std::array<bool, legs>& stands,
                                                         const std::array<Vector, legs>& arms) const {
  // f_i = A_i' y with (sum A_i A_i' + slack) y = b, and A_i = [1; [r_i]x / l]
  std::array<std::array<double, 6>, 6> m{};
  for (std::size_t i = 0; i < 6; ++i) m[i][i] = slack[i];
  for (std::size_t leg = 0; leg < legs; ++leg) {
    if (!stands[leg]) continue;
    const double x = arms[leg].x / length, y = arms[leg].y / length, z = arms[leg].z / length;
    const double a[6][3] = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, -z, y}, {z, 0, -x}, {-y, x, 0}};
    for (std::size_t i = 0; i < 6; ++i)
      for (std::size_t j = 0; j < 6; ++j) m[i][j] += a[i][0] * a[j][0] + a[i][1] * a[j][1] + a[i][2] * a[j][2];
  }
  const Vector &f = wanted.force, t = (1 / length) * wanted.torque;
  std::array<double, 6> b{f.x, f.y, f.z, t.x, t.y, t.z};
  detail::solve(m, b);
  std::array<Vector, legs> forces{};
  for (std::size_t leg = 0; leg < legs; ++leg) {
    if (!stands[leg]) continue;
    Vector& force = forces[leg];
    force = Vector{b[0], b[1], b[2]} + cross(Vector{b[3], b[4], b[5]}, (1 / length) * arms[leg]);
    force.z = std::clamp(force.z, least, most);
    const double across = muro_hypot(force.x, force.y), bound = friction * force.z;
    if (across > bound) force.x *= bound / across, force.y *= bound / across;
  }
  return forces;
}

/// Gains of springs and dampers that hold the body, relative to the mass and the inertia that they move.
struct BodyGains {
  double speed = 8;                      ///< 1/s: acceleration / missing speed along the ground
  double trim = 1;                       ///< 1/s: rate at which speed that stays missing is added to the wanted speed
  double height = 150, climb = 20;       ///< 1/s^2, 1/s
  double attitude = 200, rotation = 25;  ///< 1/s^2, 1/s: roll and pitch
  double heading = 40, turn = 15;        ///< 1/s^2, 1/s: yaw
  double place = 20;                     ///< 1/s^2: pull to the place over the feet while all of them stand
};

}  // namespace quadruped
