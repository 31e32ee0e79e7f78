// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "core/algorithm_setup.hpp"
#include "core/registry.hpp"

namespace muro {

/// Uses of algorithms after merging. Uses that share an instance are one: robots of one world (Capability::world), and
/// items that differ only in what they serve (Capability::batched). Motions that move robots of one model are one use
/// even when they belong to several groups.
struct MergedSetups {
  std::vector<AlgorithmSetup> merged;
  std::vector<std::size_t> merged_of_setup;  ///< index in `merged` of each given use
};

/// Merges `setups`. `sequences`: lists of indices of setups; groups may have theirs in different orders. Throws
/// SetupError when uses exclude each other.
MergedSetups merge(const std::vector<AlgorithmSetup>& setups, const std::vector<std::vector<std::size_t>>& sequences,
                   Registry& registry);

}  // namespace muro
