// SPDX-License-Identifier: MIT
#pragma once

#include "core/simulation.hpp"
#include "host/scenario/algorithms.hpp"
#include "host/scenario/start_pose.hpp"

namespace muro::host {

/// A robot that is added once more as a shadow: see keys::shadow_of.
struct ShadowSetup {
  const RobotTemplate* robot_template;
  const RobotTree* tree;
  const StartPose* start;
  Pose pose;
  const RobotView* robot;
  const Subsystem* motion;  ///< that moves the shadow
};

/// Adds the shadow, which is moved by another motion on the same commands, and the algorithm that measures its
/// deviation.
void add_shadow(Simulation& simulation, Algorithms& algorithms, const ShadowSetup& setup, Problems& problems);

}  // namespace muro::host
