// SPDX-License-Identifier: MIT
#pragma once

#include "core/simulation.hpp"
#include "host/scenario/algorithms.hpp"
#include "host/scenario/start_pose.hpp"

namespace muro::host {

/// A robot that is added a second time, as a shadow: see keys::shadow_of.
struct ShadowSetup {
  const RobotTemplate* robot_template;
  const RobotTree* tree;
  const StartPose* start;
  Pose pose;
  const RobotView* robot;
  const Subsystem* motion;  ///< the motion of the shadow
};

/// Adds the shadow, which another motion moves with the same commands, and the algorithm that measures its deviation.
void add_shadow(Simulation& simulation, Algorithms& algorithms, const ShadowSetup& setup, Problems& problems);

}  // namespace muro::host
