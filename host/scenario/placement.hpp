// SPDX-License-Identifier: MIT
#pragma once

#include <map>
#include <string>
#include <vector>

#include "host/scenario/scenario.hpp"
#include "muro/geometry.hpp"

namespace muro::host {

/// A disc on the ground that something occupies.
struct Footprint {
  double x, y, radius;  ///< m
};
/// A box on the ground, turned about z.
struct Obstacle {
  Pose pose;
  double half_x, half_y;  ///< m
};

/// Poses for `count` copies. `standing` is the height (m) of the base when it stands on z = 0, used where
/// no z is given. Random places keep `placement.clearance` to `taken` and `obstacles`; what they use is
/// added to `taken`. Throws SetupError when the copies do not fit.
std::vector<Pose> place(const Placement& placement, int count, double standing, double radius,
                        const std::map<std::string, std::vector<Rectangle>>& places,
                        const std::vector<Obstacle>& obstacles, std::vector<Footprint>& taken, const std::string& what);

}  // namespace muro::host
