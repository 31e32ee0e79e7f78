// SPDX-License-Identifier: MIT
// Corrects the path of a robot, whose joints move no mass, after an impact within the last step.
#pragma once

#include "move.hpp"
#include "plugins/common/contact_geometry/impact_path.hpp"

namespace muro::simplified {

using contact_geometry::correct_path;

inline void correct_path(double* pose, double* twist, const RigidMass& mass, const ImpactCorrection& impact) {
  const auto matrix = [](const double* c) {
    return lane::M3<double>{lane::splat<double>(c), lane::splat<double>(c + 3), lane::splat<double>(c + 6)};
  };
  correct_path(pose, twist, {lane::splat<double>(mass.com), {0, 0, 0}, matrix(mass.inertia)}, matrix(mass.inverse),
               mass.inverse_mass, impact);
}

}  // namespace muro::simplified
