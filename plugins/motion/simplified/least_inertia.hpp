// SPDX-License-Identifier: MIT
// Inertias that contacts can hold.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "muro/algorithm.hpp"
#include "muro/robot.hpp"
#include "muro/scene.hpp"

namespace muro::simplified {

/// Model files hold inertias of 1e-9 or 1e-6 kg m^2 that nobody has measured. A contact at a corner has hardly any
/// effective mass then, for the body only turns away under it, and what holds the corner cannot hold the body. This is
/// what has to be added to `inertia` (kg m^2, about the centre of mass) so that about no axis it is less than a
/// hundredth of that of a box of uniform density. None where it is not less: a body whose mass lies within a tenth of
/// its size is possible.
std::optional<Mat3> missing_inertia(const Inertia& inertia, const Aabb& box);

/// Adds what the inertia of the whole robot lacks to its heaviest body, also for algorithms that read `inertial` later,
/// such as those of contact; whether it lacks something. The box is that around its collision shapes with the joints at
/// `positions`, one a link; without shapes that have a size (planes and meshes have none here) nothing is lacking.
/// `inertias`: of all links. [setup]
bool complete_inertia(Connector& c, const RobotView& robot, std::span<const double> positions,
                      std::vector<Inertia>& inertias);

}  // namespace muro::simplified
