// SPDX-License-Identifier: MIT
// Effective masses of the links of robots.
#pragma once

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
std::vector<MassProperties> apparent_masses(std::span<const Link> links, std::span<const Inertia> inertias,
                                            std::span<const double> positions, std::span<const std::uint32_t> bodies);

}  // namespace muro::penalty
