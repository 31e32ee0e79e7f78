// SPDX-License-Identifier: MIT
// Counts the instructions of scenes by callgrind.
#pragma once

#include <utility>

#include "tests/costs/budgets.hpp"

namespace muro::costs {

/// The file of the source tree.
inline constexpr const char* budgets_file = MURO_TEST_SOURCE_DIR "/tests/costs/budgets.txt";

/// Runs the scenes of that file on one thread with packs of AVX2; returns for each what it costs. Throws
/// std::runtime_error with what valgrind says when that fails.
std::vector<std::pair<SceneBudget, Costs>> count();

}  // namespace muro::costs
