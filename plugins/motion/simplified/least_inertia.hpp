// SPDX-License-Identifier: MIT
// Inertias that are large enough for contacts.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "muro/algorithm.hpp"
#include "muro/robot.hpp"
#include "muro/scene.hpp"
#include "plugins/common/mesh/store.hpp"

namespace muro::simplified {

/// Adds the missing inertia of the whole robot to its heaviest body, also for algorithms that read `inertial` later,
/// such as contact algorithms. Returns whether some was missing. The box is around the collision shapes with the joints
/// at `positions` (one per link); without shapes that have a size (planes have none) nothing is missing. `inertias`: of
/// all links. `meshes`: reads the meshes of the shapes. [setup]
bool complete_inertia(Connector& c, const RobotView& robot, std::span<const double> positions,
                      std::vector<Inertia>& inertias, mesh::Store& meshes);

}  // namespace muro::simplified
