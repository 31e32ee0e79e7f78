// SPDX-License-Identifier: MIT
// Budgets of instructions: the number that each plugin may execute in a scene, and the number that it does.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

namespace muro::costs {

/// Instructions of a shared object, or of the core, and of its functions.
struct Cost {
  std::uint64_t instructions = 0;
  std::map<std::string, std::uint64_t> functions;  ///< by name; in budgets only those that matter
};

/// Costs by plugin, such as `motion_simplified`; `core` for what is linked into the program.
using Costs = std::map<std::string, Cost>;

/// A scene, its duration, and its allowed costs.
struct SceneBudget {
  std::string name;
  std::string scenario;                ///< path in the source tree
  double warm_up = 0, duration = 0;    ///< s, before and while instructions are counted
  std::vector<std::string> overrides;  ///< `path=value`
  Costs costs;
};

/// Reads a file of budgets. A scene is a line `NAME | SCENARIO | WARM-UP | DURATION | OVERRIDES`; lines
/// `INSTRUCTIONS PLUGIN` follow it, and after each of these, indented, `INSTRUCTIONS FUNCTION`. Throws
/// std::runtime_error.
std::vector<SceneBudget> read_budgets(const std::string& file);

/// Writes such a file and keeps the comments at its head. It keeps plugins that take at least a hundredth of the
/// instructions of a scene, and functions that take at least a twentieth of those of a plugin.
void write_budgets(const std::string& file, const std::vector<SceneBudget>& scenes);

/// Reads a file that callgrind has written without compression (`--compress-strings=no --compress-pos=no`):
/// instructions executed in each function itself. Objects outside of `plugin_folder` and `program` are left out,
/// because the project does not control libraries. Throws std::runtime_error.
Costs read_callgrind(const std::string& file, const std::string& plugin_folder, const std::string& program);

/// Returns what has grown beyond `budget` by more than `allowance` (0.02: 2 %), one line each: scene, plugin, and the
/// functions that have grown most. A plugin that costs much less is no problem; a new plugin that costs at least a
/// hundredth of the scene is.
std::vector<std::string> grown(const SceneBudget& budget, const Costs& now, double allowance);

}  // namespace muro::costs
