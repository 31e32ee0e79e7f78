// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/simulation.hpp"
#include "host/outputs/odometer.hpp"

namespace muro::host {

/// The outcome of a run.
struct RunResult {
  std::string scenario;
  std::uint64_t seed = 1;
  double simulated = 0;  ///< s
  double wall = 0;       ///< wall-clock time, s
  bool interrupted = false;
  std::string error;  ///< reason of an early end, or empty
};

/// Returns the ids of the algorithms that do not declare the capability `deterministic`: with one of them, two runs of
/// one scenario may end in different states.
std::vector<std::string> nondeterministic_algorithms(const Simulation& simulation);

nlohmann::ordered_json report(const RunResult& run, const Simulation& simulation, const Odometer& odometer);
/// Returns the cost of each algorithm as a table.
std::string profile(const RunResult& run, const Simulation& simulation);

}  // namespace muro::host
