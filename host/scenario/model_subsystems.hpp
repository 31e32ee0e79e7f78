// SPDX-License-Identifier: MIT
#pragma once

#include "core/robot_tree.hpp"
#include "host/scenario/algorithms.hpp"

namespace muro::host {

/// Adds the subsystems in the model of a robot (`model.subsystems`: sensors, drives, parameters of motions) to its
/// subsystems. Entries of the scenario with the same name have priority. `file`: path of the model. Afterwards every
/// subsystem of the template has a `use`; changes of subsystems that the model does not have are problems.
void add_model_subsystems(RobotTemplate& t, const RobotTree& tree, const std::string& file, Algorithms& algorithms,
                          Problems& problems);

}  // namespace muro::host
