// SPDX-License-Identifier: MIT
#pragma once

#include "core/robot_tree.hpp"
#include "host/scenario/algorithms.hpp"

namespace muro::host {

/// Sets targets and gains of joints in the motions of a robot to those in its model (`joint.drive`). The scenario has
/// priority: values in `joints`, in a list that names the joint, or as gains are kept.
void add_model_drives(RobotTemplate& t, const RobotTree& tree, Algorithms& algorithms);

}  // namespace muro::host
