// SPDX-License-Identifier: MIT
#include "sweep.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace muro::scanner {

Sweep::Sweep(const Grid& grid, bool is_list, std::uint32_t steps) : first_(steps + 1, grid.columns) {
  std::uint32_t next = 0;  // step whose first column is not known yet
  for (std::uint32_t column = 0; column < grid.columns; ++column) {
    const double turn =
        is_list ? double(column) / grid.columns : (grid.azimuth(column) - grid.first_angle()) / (2 * std::numbers::pi);
    const double at = turn * steps;
    const std::uint32_t step = std::min(std::uint32_t(std::max(at, 0.0)), steps - 1);
    while (next <= step) first_[next++] = column;
    moments_.push_back(std::clamp(at - step, 0.0, 1.0));
    last_step_ = step;
  }
}

Pose between(const Pose& a, const Pose& b, double share) {
  Quat turn = a.orientation.conjugate() * b.orientation;
  if (turn.w() < 0) turn.coeffs() *= -1;
  const double sine = turn.vec().norm();
  const double angle = 2 * std::atan2(sine, turn.w());
  const Vec3 v = sine > 1e-12 ? Vec3(turn.vec() * (angle / sine)) : Vec3(2 * turn.vec());
  const Vec3 way = a.orientation.conjugate() * Vec3(b.position - a.position);
  const Vec3 speed = screw_integral(v).inverse() * way, part = share * v;
  return {a.position + a.orientation * Vec3(screw_integral(part) * Vec3(share * speed)),
          Quat(a.orientation * rotation_of(part)).normalized()};
}

}  // namespace muro::scanner
