// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "muro/connector.hpp"

namespace muro::watch {

/// How far a robot reaches, and how fast its drives can make it: bounds for all positions of its joints.
struct Reach {
  /// Of each link, m: from its frame to the farthest point of it and of the links that it carries.
  std::vector<double> of_link;
  /// m/s, from the base: of the fastest point, by the limits of the joints.
  double drive_speed = 0;
};

/// From the constants of the robot. A joint without a limit counts with 100 rad/s or 10 m/s and no travel, a mesh,
/// whose file is not read here, by the inertia of its link. [setup]
Reach reach_of(const Connector& c, const RobotView& robot);

}  // namespace muro::watch
