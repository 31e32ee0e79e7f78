// SPDX-License-Identifier: MIT
// Inertias that contacts can hold.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "muro/algorithm.hpp"
#include "muro/robot.hpp"
#include "muro/scene.hpp"
#include "plugins/common/mesh/store.hpp"

namespace muro::simplified {

/// Adds what the inertia of the whole robot lacks to its heaviest body, also for algorithms that read `inertial` later,
/// such as those of contact; whether it lacks something. The box is that around its collision shapes with the joints at
/// `positions`, one a link; without shapes that have a size (planes have none) nothing is lacking. `inertias`: of all
/// links. `meshes`: reads those of the shapes. [setup]
bool complete_inertia(Connector& c, const RobotView& robot, std::span<const double> positions,
                      std::vector<Inertia>& inertias, mesh::Store& meshes);

}  // namespace muro::simplified
