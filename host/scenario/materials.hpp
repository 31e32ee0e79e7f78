// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/robot_tree.hpp"
#include "host/scenario/node.hpp"
#include "host/scenario/problems.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// Reads `materials` of a robot or of one of its variants, which `what` names: `{team: {color: [0.8, 0.1, 0.1]},
/// number: {texture: 7.png}}`. Adds a problem for each value of a wrong kind or out of its range.
std::vector<MaterialChange> read_materials(const Node& materials, const std::string& what, Problems& problems);

/// Replaces materials of the model of robot `name` by those in the scenario. Adds a problem for each material that the
/// model does not have.
void set_materials(RobotTree& tree, const std::string& name, const std::vector<MaterialChange>& changes,
                   Problems& problems);

}  // namespace muro::host
