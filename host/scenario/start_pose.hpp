// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/robot_tree.hpp"
#include "host/scenario/problems.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// Where the joints of the robots of a template stand at the start.
struct StartPose {
  std::vector<double> positions;     ///< rad or m, of the joint of each link; 0 for fixed ones
  std::vector<std::string> clamped;  ///< "`elbow` at 0.1 (0.1 to 2 rad)": those that cannot start as modelled
};

/// Joints stand where the scenario puts them (`joints`), else where the model has them, at 0 where it does not say, or
/// at the limit that is nearest to that; those that mimic another follow it. Adds a problem for each entry of `joints`
/// that names no joint, or a position outside of its limits.
StartPose start_pose(const RobotTree& tree, const RobotTemplate& t, Problems& problems);

}  // namespace muro::host
