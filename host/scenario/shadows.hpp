// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "core/simulation.hpp"

namespace muro::host {

/// The deviation of a shadow from its robot in a run.
struct ShadowResult {
  std::string robot;
  std::string motion;                      ///< motion of the shadow: "motion.ode"
  double distance = 0, angle = 0;          ///< at the end: m, rad
  double max_distance = 0, max_angle = 0;  ///< over the run: m, rad
};

/// Returns the deviations of all shadows in the scene.
std::vector<ShadowResult> shadow_results(const Simulation& simulation);

/// Whether the robot is a shadow of another robot.
bool is_shadow(const Simulation& simulation, const RobotView& robot);

}  // namespace muro::host
