// SPDX-License-Identifier: MIT
// Wheels with rollers: the equation of the Swedish wheel of Siegwart, Nourbakhsh and Scaramuzza, Introduction to
// Autonomous Mobile Robots, 2nd edition, section 3.2.3, written with vectors.
#pragma once

#include <span>
#include <vector>

#include "planar.hpp"
#include "plugins/common/wheels/omni_wheels.hpp"

namespace muro::wheeled {

/// Only along the axis of the roller on the ground, the direction e, does the ground hold the wheel: there its centre
/// at c moves as the wheel turns, e (v + w z x c) = r dq/dt cos(g), g the roller angle. Here: rad/s of the wheel's
/// joint for each m/s along x, m/s along y and rad/s of the base.
inline PlanarTwist asks_of(const OmniWheel& w) {
  const double c = std::cos(w.roller_angle), s = std::sin(w.roller_angle);
  const Vec3 &h = w.heading, &p = w.centre;
  const double ex = c * h.x() - s * h.y(), ey = s * h.x() + c * h.y();
  return PlanarTwist{ex, ey, p.x() * ey - p.y() * ex} * (1 / (w.radius * c));
}

/// For each wheel the velocity of the base per rad/s of its joint: the solution of all wheels' equations, or, with more
/// than three wheels whose speeds do not fit together, the one of least squares of the velocities along the rollers'
/// axes. Throws Error when the wheels leave a motion free. [setup]
std::vector<PlanarTwist> shares_of(const RobotView& robot, std::span<const OmniWheel> wheels);

}  // namespace muro::wheeled
