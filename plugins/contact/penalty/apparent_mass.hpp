// SPDX-License-Identifier: MIT
// Effective masses of the links of robots.
#pragma once

#include <Eigen/Core>
#include <span>
#include <vector>

#include "muro/robot.hpp"
#include "patch.hpp"

namespace muro::penalty {

/// Returns the mass properties of a rigid body.
MassProperties mass_properties_of(const Inertia& body);

/// Masses that forces on `bodies` (numbers of links) seem to move when all joints are free. They follow from J M^-1 J^T
/// of each body at its centre of mass (Khatib, A unified approach for motion and force control, IEEE J. Robotics and
/// Automation 3, 1987), without the coupling of translation and rotation. The mass is that of the direction with the
/// greatest inverse mass: joints that are held make a body heavier than that, never lighter. `inertias` and `positions`
/// (rad or m): one for each link.
struct ApparentMasses {
  static constexpr std::size_t most_touched = 32;

  std::vector<MassProperties> bodies;
  /// J M^-1 J^T of all bodies, in units of their own inverse masses and inertias: 6 rows for each body.
  Eigen::MatrixXd coupling;

  /// Returns the largest ratio of the masses that several bodies seem to have to the mass that moves, when forces act
  /// on these bodies (`touched`: numbers in `bodies`). Each of them counts the mass that they share. The ratio is the
  /// largest eigenvalue of their part of `coupling`.
  double shared_by(std::span<const std::uint32_t> touched) const;
};
ApparentMasses apparent_masses(Rows<Link> links, std::span<const Inertia> inertias, std::span<const double> positions,
                               std::span<const std::uint32_t> bodies);

}  // namespace muro::penalty
