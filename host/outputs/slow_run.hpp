// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "core/simulation.hpp"

namespace muro::host {

/// Reports once that a run falls far behind real time: names the algorithm that takes the time, and a remedy.
class SlowRun {
 public:
  static constexpr double slow = 0.1;    ///< simulated seconds per second of the wall clock
  static constexpr double patience = 5;  ///< s of the wall clock, after which a run is judged

  explicit SlowRun(const Simulation& simulation) : simulation_(simulation) {}

  /// Returns a message when the run is slow, else an empty text; to be called now and then, at `wall` s of the run. A
  /// run that waits, for its pace or for a user, is not slow.
  std::string note(double wall);

 private:
  const Simulation& simulation_;
  bool told_ = false;
};

}  // namespace muro::host
