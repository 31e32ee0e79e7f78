// SPDX-License-Identifier: MIT
#pragma once

#include <memory>
#include <string>
#include <vector>

#include "core/simulation.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// A simulation made from a scenario, connected and started.
struct BuiltScenario {
  Scenario scenario;
  std::unique_ptr<Simulation> simulation;
  std::vector<std::string> notes;  ///< what readers and defaults had to say, a line each
};

/// Adds what the scenario leaves open: kinematics for every robot, and, where something needs them, the
/// spatial index, collision detection and contact forces. Throws SetupError with every problem found.
BuiltScenario build(Scenario scenario, Registry& registry);
/// What `threads: all` means on this machine.
unsigned all_threads();

}  // namespace muro::host
