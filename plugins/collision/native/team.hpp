// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <span>
#include <utility>
#include <vector>

#include "lanes/spot.hpp"
#include "muro/simd/numbers.hpp"
#include "muro/step.hpp"

namespace muro::native {

/// Robots of identical structure, which kernels take side by side.
template <class Structure>
struct Team {
  Structure structure;
  std::vector<std::uint32_t> robots;  ///< by rising number

  /// Those of a block.
  std::span<const std::uint32_t> in(Range block) const {
    const auto first = std::lower_bound(robots.begin(), robots.end(), block.begin);
    return {first, std::lower_bound(first, robots.end(), block.end)};
  }
};

/// Where a body's pose lies; the first link's takes its place in `poses`.
inline Spot spot_of(Poses& poses, const double* pose) {
  if (pose == poses.base) return {};
  if (!poses.links) poses.links = pose;
  return {.of_base = false, .behind = lane::numbers_between(poses.links, pose)};
}

/// `robot` has a higher number than all before.
template <class Structure>
void join_team(std::vector<Team<Structure>>& teams, Structure structure, std::uint32_t robot) {
  for (Team<Structure>& t : teams)
    if (t.structure == structure) return t.robots.push_back(robot);
  teams.push_back({std::move(structure), {robot}});
}

}  // namespace muro::native
