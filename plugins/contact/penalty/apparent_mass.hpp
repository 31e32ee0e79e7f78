// SPDX-License-Identifier: MIT
// Effective masses of the links of robots.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "muro/robot.hpp"
#include "patch.hpp"

namespace muro::penalty {

/// Of a rigid body.
MassProperties mass_properties_of(const Inertia& body);

/// What a force on each of `bodies` (numbers of links) would seem to move when all joints are free: the apparent
/// inertia J M^-1 J^T of the body at its centre of mass (Khatib, A unified approach for motion and force control, IEEE
/// J. Robotics and Automation 3, 1987), without the coupling of translation and rotation, and with the greatest of the
/// inverse masses of all directions: joints that are held make a body heavier than that, never lighter. `inertias` and
/// `positions` (rad or m): one a link.
struct ApparentMasses {
  static constexpr std::size_t most_touched = 32;

  std::vector<MassProperties> bodies;
  /// J M^-1 J^T of all of them, in units of their own inverse masses and inertias: 6 rows a body.
  Eigen::MatrixXd coupling;

  /// How many times heavier bodies seem when forces act on several of them (numbers in `bodies`) than what moves, at
  /// most: each of them counts what they share. That is the largest eigenvalue of their part of `coupling`.
  double shared_by(std::span<const std::uint32_t> touched) const;
};
ApparentMasses apparent_masses(Rows<Link> links, std::span<const Inertia> inertias, std::span<const double> positions,
                               std::span<const std::uint32_t> bodies);

}  // namespace muro::penalty
