// SPDX-License-Identifier: MIT
// Counts the instructions of scenes with callgrind.
#pragma once

#include <utility>

#include "tests/costs/budgets.hpp"

namespace muro::costs {

/// Path of the file in the source tree.
inline constexpr const char* budgets_file = MURO_TEST_SOURCE_DIR "/tests/costs/budgets.txt";

/// Runs the scenes of that file on one thread with packs of AVX2 and returns the costs of each. Throws
/// std::runtime_error with the text of valgrind on failure.
std::vector<std::pair<SceneBudget, Costs>> count();

}  // namespace muro::costs
