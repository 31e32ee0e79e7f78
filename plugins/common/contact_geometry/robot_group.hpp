// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "muro/simd/numbers.hpp"
#include "muro/step.hpp"
#include "pose_location.hpp"

namespace muro::contact_geometry {

/// Robots of identical structure that SIMD kernels process side by side.
template <class Structure>
struct RobotGroup {
  Structure structure;
  std::vector<std::uint32_t> robots;  ///< by rising number

  /// Returns the robots of a block.
  std::span<const std::uint32_t> in(Range block) const {
    const auto first = std::lower_bound(robots.begin(), robots.end(), block.begin);
    return {first, std::lower_bound(first, robots.end(), block.end)};
  }
};

/// Returns the location of a body's pose. The first link that is passed becomes the reference in `poses`.
inline PoseLocation location_of(RobotPoses& poses, const double* pose) {
  if (pose == poses.base) return {};
  if (!poses.links) poses.links = pose;
  return {.of_base = false, .offset = lane::numbers_between(poses.links, pose)};
}

/// Adds a robot to the group of its structure. `robot` must be higher than all numbers before.
template <class Structure>
void add_to_group(std::vector<RobotGroup<Structure>>& groups, Structure structure, std::uint32_t robot) {
  for (RobotGroup<Structure>& group : groups)
    if (group.structure == structure) return group.robots.push_back(robot);
  groups.push_back({std::move(structure), {robot}});
}

}  // namespace muro::contact_geometry
