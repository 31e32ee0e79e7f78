// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "muro/connector.hpp"

namespace muro::watch {

/// Upper bounds of the size of a robot and of the speed that its drives can give it, for all positions of its joints.
struct Reach {
  /// m, for each link: distance from its frame to the farthest point of the link and of the links that it carries.
  std::vector<double> of_link;
  /// m/s, relative to the base: speed of the fastest point by the limits of the joints.
  double drive_speed = 0;
};

/// Computes the reach from the constants of the robot. A joint without limits counts with 100 rad/s or 10 m/s and no
/// travel. Mesh files are not read: the size of a mesh follows from the inertia of its link. [setup]
Reach reach_of(const Connector& c, const RobotView& robot);

}  // namespace muro::watch
