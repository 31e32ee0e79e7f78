// SPDX-License-Identifier: MIT
// Wheels with rollers: the equation of the Swedish wheel of Siegwart, Nourbakhsh and Scaramuzza, Introduction to
// Autonomous Mobile Robots, 2nd edition, section 3.2.3, written with vectors.
#pragma once

#include <Eigen/SVD>

#include "muro/omni_wheels.hpp"
#include "planar.hpp"

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
inline std::vector<PlanarTwist> shares_of(const RobotView& robot, std::span<const OmniWheel> wheels) {
  Eigen::MatrixXd rows(wheels.size(), 3);
  double length = 0;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    const double k = wheels[i].radius * std::cos(wheels[i].roller_angle);
    const PlanarTwist e = asks_of(wheels[i]) * k;
    rows.row(Eigen::Index(i)) = Vec3(e.x, e.y, e.turn).transpose();
    length = std::max(length, wheels[i].centre.head<2>().norm());
  }
  Vec3 scale(1, 1, length > 0 ? 1 / length : 1);
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(rows * scale.asDiagonal(), Eigen::ComputeThinU | Eigen::ComputeThinV);
  if (svd.singularValues()[2] < 1e-6 * svd.singularValues()[0])
    throw Error(
        "the wheels of `" + std::string(robot.name) +
        "` do not hold it: with all of them at rest it can still move. Look at their places, and at "
        "`roller_angle`: the axes of the rollers on the ground must neither be all parallel nor meet in a point");
  const Eigen::MatrixXd inverse = scale.asDiagonal() * svd.solve(Eigen::MatrixXd::Identity(rows.rows(), rows.rows()));
  std::vector<PlanarTwist> shares;
  for (std::size_t i = 0; i < wheels.size(); ++i) {
    const Vec3 v = inverse.col(Eigen::Index(i)) * (wheels[i].radius * std::cos(wheels[i].roller_angle));
    shares.push_back({v.x(), v.y(), v.z()});
  }
  return shares;
}

}  // namespace muro::wheeled
