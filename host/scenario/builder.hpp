// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/simulation.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// A simulation that was built from a scenario, connected and started.
struct BuiltScenario {
  Scenario scenario;
  std::unique_ptr<Simulation> simulation;
  std::vector<std::string> notes;            ///< warnings and notes of readers, one line each
  std::vector<std::string> lost_collisions;  ///< those of them about omitted collision shapes, as errors
  std::vector<std::string> clamped;          ///< robots with joints that cannot start at 0, one line each

  /// Adds a message of a file's reader as a note, or as a warning if it is more serious.
  void note(const std::string& file, const RobotTree::Problem& problem);
};

/// Adds what the scenario leaves open: kinematics for every robot, and the spatial index, collision detection and
/// contact forces when an algorithm reads what they write. Throws SetupError with every problem found. `add_more`: adds
/// what a command needs in addition to the scenario, before the algorithms are connected.
BuiltScenario build(Scenario scenario, Registry& registry, const std::function<void(Simulation&)>& add_more = {});
/// Returns the number of threads for `threads: all` on this machine.
unsigned all_threads();

}  // namespace muro::host
