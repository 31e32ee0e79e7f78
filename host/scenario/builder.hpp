// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
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
/// `more`: adds what the command needs beside the scenario, before all is connected.
BuiltScenario build(Scenario scenario, Registry& registry, const std::function<void(Simulation&)>& more = {});
/// What `threads: all` means on this machine.
unsigned all_threads();

}  // namespace muro::host
