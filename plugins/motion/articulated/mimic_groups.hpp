// SPDX-License-Identifier: MIT
// Mimic joints whose ways to their leaders share bodies, for which the kernel finds the efforts together.
#pragma once

#include <vector>

#include "structure.hpp"

namespace muro::articulated {

struct MimicGroups {
  std::vector<MimicGroup> groups;  ///< by anchor, in falling order
  std::vector<MimicWay> ways;      ///< one a mimic joint, those of a group side by side
  std::vector<int> bodies;         ///< of groups, in rising order
  std::vector<int> places;         ///< of ways, in falling order
  int numbers = 0;                 ///< see Structure::mimic_numbers

  bool operator==(const MimicGroups&) const = default;
};

/// [setup]
MimicGroups mimic_groups_of(const std::vector<Body>& bodies, const std::vector<Joint>& joints);

}  // namespace muro::articulated
