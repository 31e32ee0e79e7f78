// SPDX-License-Identifier: MIT
// Groups of mimic joints whose ways to their leaders share bodies. The kernel finds the efforts of a group together.
#pragma once

#include <vector>

#include "structure.hpp"

namespace muro::articulated {

struct MimicGroups {
  std::vector<MimicGroup> groups;  ///< sorted by anchor, in falling order
  std::vector<MimicWay> ways;      ///< one per mimic joint, those of a group side by side
  std::vector<int> bodies;         ///< bodies of groups, each in rising order
  std::vector<int> places;         ///< places of ways, each in falling order
  int numbers = 0;                 ///< see Structure::mimic_numbers

  bool operator==(const MimicGroups&) const = default;
};

/// Returns the groups of the mimic joints. [setup]
MimicGroups mimic_groups_of(const std::vector<Body>& bodies, const std::vector<Joint>& joints);

}  // namespace muro::articulated
