// SPDX-License-Identifier: MIT
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "core/simulation.hpp"

namespace muro::host {

/// What is watched while a scenario runs, beside the simulation and without influence on it.
class Odometer {
 public:
  explicit Odometer(const Simulation& simulation);
  /// Adds the straight way since the last sample to every robot's distance.
  void sample();
  /// Throws StepError when a robot's pose is not finite.
  void check() const;
  double distance(std::uint32_t robot) const { return distances_[robot]; }  ///< m

  static constexpr std::int64_t period = 100'000'000;  ///< ns between samples

 private:
  const Simulation& simulation_;
  std::vector<Vec3> last_;
  std::vector<double> distances_;
};

/// What a run was and what came of it.
struct RunResult {
  std::string scenario;
  std::uint64_t seed = 1;
  double simulated = 0;  ///< s
  double wall = 0;       ///< s
  bool interrupted = false;
  std::string error;  ///< why it ended before its time, or empty
};

nlohmann::ordered_json report(const RunResult& run, const Simulation& simulation, const Odometer& odometer);
/// The cost of each algorithm as a table.
std::string profile(const RunResult& run, const Simulation& simulation);
/// Writes a file whole or not at all. Throws SetupError.
void write_file(const std::string& path, const std::string& text);
/// Throws SetupError when the file could not be written; leaves a file that is there as it is.
void check_writable(const std::string& path);

}  // namespace muro::host
