// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/robot_tree.hpp"
#include "host/scenario/node.hpp"
#include "host/scenario/problems.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// Reads `materials` of a robot or of one of its variants, which `what` names:
/// `{team: {color: [0.8, 0.1, 0.1]}, number: {texture: 7.png}}`. Adds a problem for each value that is of another kind
/// or out of its range.
std::vector<MaterialChange> read_materials(const Node& materials, const std::string& what, Problems& problems);

/// Puts what the scenario says of materials of the robot `name` in place of what its model says. Adds a problem for
/// each that the model does not have.
void set_materials(RobotTree& tree, const std::string& name, const std::vector<MaterialChange>& changes,
                   Problems& problems);

}  // namespace muro::host
