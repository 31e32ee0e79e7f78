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
  std::vector<std::string> notes;            ///< warnings and notes of readers, a line each
  std::vector<std::string> lost_collisions;  ///< those of them that tell of collision shapes left out, as errors
  std::vector<std::string> clamped;          ///< robots whose joints cannot start at 0, a line each

  /// Takes what the reader of a file has said as a note, or as a warning if it is more.
  void note(const std::string& file, const RobotTree::Problem& problem);
};

/// Adds what the scenario leaves open: kinematics for every robot, and, where an algorithm reads what they write, the
/// spatial index, collision detection and contact forces. Throws SetupError with every problem found.
/// `add_more`: adds what a command needs beside the scenario, before the algorithms are connected.
BuiltScenario build(Scenario scenario, Registry& registry, const std::function<void(Simulation&)>& add_more = {});
/// The number of threads that `threads: all` stands for on this machine.
unsigned all_threads();

}  // namespace muro::host
