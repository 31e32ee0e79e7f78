// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/robot_tree.hpp"
#include "host/scenario/problems.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// Positions of the joints of a template's robots at the start.
struct StartPose {
  std::vector<double> positions;     ///< rad or m, for the joint of each link; 0 for fixed ones
  std::vector<std::string> clamped;  ///< "`elbow` at 0.1 (0.1 to 2 rad)": joints that cannot start as modelled
};

/// Returns the positions that the scenario gives (`joints`), or else those of the model. A joint without either starts
/// at 0, or at the limit that is nearest to 0; mimic joints follow their leader. Adds a problem for each entry of
/// `joints` that names no joint, or a position outside of its limits.
StartPose start_pose(const RobotTree& tree, const RobotTemplate& t, Problems& problems);

}  // namespace muro::host
