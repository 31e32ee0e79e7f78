// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/robot_tree.hpp"
#include "host/scenario/map_reader.hpp"
#include "host/scenario/problems.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// Reads `dynamics` of a robot: `{knee: {damping: 0.1, friction: 0.05, armature: 0.012}, "arm_*": {...}}`. Adds a
/// problem for each value of a wrong kind or out of its range.
std::vector<JointDynamics> read_joint_dynamics(MapReader& robot, Problems& problems);

/// Replaces values of the model's joints by those that the scenario gives for `t`. They are set in the order of the
/// file, so the last entry for a joint counts. Adds a problem for each entry that names no joint.
void set_joint_dynamics(RobotTree& tree, const RobotTemplate& t, Problems& problems);

}  // namespace muro::host
