// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/algorithm_setup.hpp"
#include "core/registry.hpp"

namespace muro {

/// Uses of algorithms, where those that share an instance are one: robots of one world (Capability::world), and items
/// that are alike but for what they serve (Capability::batched). Of motions, which move robots of one model side by
/// side, those of several groups are one, too.
struct MergedSetups {
  std::vector<AlgorithmSetup> merged;
  std::vector<std::size_t> merged_of_setup;  ///< for each of those that were given, its number in `merged`
};

/// `sequences`: of numbers of setups; groups may have theirs in different orders. Throws SetupError where uses exclude
/// each other.
MergedSetups merge(const std::vector<AlgorithmSetup>& setups, const std::vector<std::vector<std::size_t>>& sequences,
                   Registry& registry);

}  // namespace muro
