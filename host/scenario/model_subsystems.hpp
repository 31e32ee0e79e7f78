// SPDX-License-Identifier: MIT
#pragma once

#include "core/robot_tree.hpp"
#include "host/scenario/algorithms.hpp"

namespace muro::host {

/// Adds what the model of a robot brings (`model.subsystems`: sensors, drives, parameters of motions) to its
/// subsystems. What the scenario says under the same name goes before. `file`: of the model. Afterwards every subsystem
/// of the template has a `use`; changes of what the model does not bring are problems.
void add_model_subsystems(RobotTemplate& t, const RobotTree& tree, const std::string& file, Algorithms& algorithms,
                          Problems& problems);

}  // namespace muro::host
