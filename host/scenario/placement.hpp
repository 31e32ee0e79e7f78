// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <map>
#include <string>
#include <vector>

#include "host/scenario/occupancy.hpp"
#include "host/scenario/scenario.hpp"
#include "muro/geometry.hpp"

namespace muro::host {

/// A body to be placed.
struct Body {
  std::string name;  ///< name in messages
  /// Height (m) of the origin at a pose, for poses without z; the height of the pose does not count. Without this
  /// function a missing z is 0.
  std::function<double(const Pose&)> height_at;
  double radius;  ///< m, radius of its footprint
};

/// Returns poses for `count` copies of a body. Random poses keep `placement.clearance` to everything in `occupied`; the
/// footprints of all copies are added to it. Throws SetupError when the copies do not fit.
std::vector<Pose> place(const Placement& placement, int count, const Body& body,
                        const std::map<std::string, std::vector<Rectangle>>& places, Occupancy& occupied);

}  // namespace muro::host
