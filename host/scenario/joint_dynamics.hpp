// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/robot_tree.hpp"
#include "host/scenario/map_reader.hpp"
#include "host/scenario/problems.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// Reads `dynamics` of a robot: `{knee: {damping: 0.1, friction: 0.05, armature: 0.012}, "arm_*": {...}}`. Adds a
/// problem for each value that is of another kind or out of its range.
std::vector<JointDynamics> read_joint_dynamics(MapReader& robot, Problems& problems);

/// Puts what the scenario says of the joints of `t` in place of what its model says, in the order of the file, so that
/// of two that name a joint the later counts. Adds a problem for each that names no joint.
void set_joint_dynamics(RobotTree& tree, const RobotTemplate& t, Problems& problems);

}  // namespace muro::host
