// SPDX-License-Identifier: MIT
#pragma once

#include "core/robot_tree.hpp"
#include "host/scenario/algorithms.hpp"

namespace muro::host {

/// What joints follow by the model of a robot (`joint.drive`), and how hard, becomes what they follow in its motions,
/// where the scenario says nothing else: neither `joints` nor a list that names the joint, and no gains.
void add_model_drives(RobotTemplate& t, const RobotTree& tree, Algorithms& algorithms);

}  // namespace muro::host
