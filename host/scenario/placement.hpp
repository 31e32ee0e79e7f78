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

/// What is placed.
struct Body {
  std::string name;  ///< in messages
  /// Where no z is given: of its origin (m) when it stands at a pose, whose own height does not count. Without it what
  /// has no z has 0.
  std::function<double(const Pose&)> height_at;
  double radius;  ///< of its footprint, m
};

/// Poses for `count` copies of a body. Random poses keep `placement.clearance` to all that is `occupied`; the
/// footprints of all copies are added to it. Throws SetupError when the copies do not fit.
std::vector<Pose> place(const Placement& placement, int count, const Body& body,
                        const std::map<std::string, std::vector<Rectangle>>& places, Occupancy& occupied);

}  // namespace muro::host
