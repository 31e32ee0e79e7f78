// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "host/scenario/scenario.hpp"
#include "muro/geometry.hpp"

namespace muro::host {

/// A disc on the ground that a robot occupies.
struct Footprint {
  double x, y, radius;  ///< m
};
/// The outline of scenery: a rectangle in the plane of its pose.
struct Obstacle {
  Pose pose;
  double half_x, half_y;  ///< m
};

/// What is placed.
struct Body {
  std::string name;        ///< in messages
  double standing_height;  ///< of its origin when it stands on z = 0, m; used where no z is given
  double radius;           ///< of its footprint, m
};

/// Poses for `count` copies of a body. Random poses keep `placement.clearance` to `occupied` and `obstacles`; the
/// footprints of all copies are added to `occupied`. Throws SetupError when the copies do not fit.
std::vector<Pose> place(const Placement& placement, int count, const Body& body,
                        const std::map<std::string, std::vector<Rectangle>>& places,
                        const std::vector<Obstacle>& obstacles, std::vector<Footprint>& occupied);

}  // namespace muro::host
