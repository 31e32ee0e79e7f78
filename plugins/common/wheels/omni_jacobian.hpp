// SPDX-License-Identifier: MIT
// Relation between the joint speeds of wheels with rollers and the velocity of the base: the equation of the Swedish
// wheel of Siegwart, Nourbakhsh and Scaramuzza, Introduction to Autonomous Mobile Robots, 2nd edition, section 3.2.3,
// written with vectors.
#pragma once

#include <span>
#include <vector>

#include "muro/base/elementary.hpp"
#include "omni_wheels.hpp"
#include "planar_motion.hpp"

namespace muro::wheels {

/// Returns the row of the inverse Jacobian of a wheel: rad/s of its joint for each m/s along x, m/s along y and rad/s
/// of the base. The ground holds the wheel only along the direction e, the axis of the roller on the ground. Along e
/// the wheel's centre at c moves as the wheel turns, e (v + w z x c) = r dq/dt cos(g), with g the roller angle.
inline PlanarTwist inverse_jacobian_row(const OmniWheel& w) {
  const auto [s, c] = elementary::sincos(w.roller_angle);
  const Vec3 &h = w.heading, &p = w.centre;
  const double ex = c * h.x() - s * h.y(), ey = s * h.x() + c * h.y();
  return PlanarTwist{ex, ey, p.x() * ey - p.y() * ex} * (1 / (w.radius * c));
}

/// Returns the columns of the Jacobian, one a wheel: velocity of the base per rad/s of the wheel's joint. The speeds of
/// more than three wheels may contradict each other. Then it is the pseudo-inverse of the inverse Jacobian, which
/// minimises the squares of the velocities along the rollers' axes. Throws Error if the wheels leave a motion free.
/// [setup]
std::vector<PlanarTwist> jacobian_columns(const RobotView& robot, std::span<const OmniWheel> wheels);

}  // namespace muro::wheels
