// SPDX-License-Identifier: MIT
// Runs of teams through the city, for time and for accuracy.
#pragma once

#include <vector>

#include "tests/bench/baselines/team.hpp"

namespace muro::bench {

/// Length of the run of an engine: several cities, each with a new seed. In each city there are timed rounds after a
/// warm-up of the same length. Runs are short, because vehicles drive blindly and end up at walls; the slowest engine
/// takes some seconds in all. A round always computes the same, and a busy machine can only make it slower: of
/// `repeats` runs through a city, the fastest of each round counts.
struct RunPlan {
  int cities, rounds, intervals, repeats = 1;
  static RunPlan for_team(int vehicles) {
    if (vehicles >= 1000) return {1, 5, 2};
    if (vehicles >= 100) return {1, 5, 8};
    return vehicles >= 10 ? RunPlan{3, 2, 20} : RunPlan{10, 2, 20};
  }
  double simulated() const { return 1e-3 * City::interval * intervals * (rounds + 1); }  ///< s in each city
};

/// Result of one engine.
struct Measurement {
  std::vector<double> rates;  ///< vehicle-steps/s of each round
  double distance = 0;        ///< m, driven by a vehicle in a city, on average
  double height = 0;          ///< m, on average after each round

  double rate() const;  ///< the median
  /// Returns the median of the ratios to the rates of `other`, round by round.
  double ratio_to(const Measurement& other) const;
};

/// Runs all engines alternately, round by round. `make_city`: makes a city from a seed.
std::vector<Measurement> compare(const RunPlan& plan, const std::vector<Engine>& engines,
                                 const std::function<City(std::uint64_t seed)>& make_city);

/// Distance of vehicles from where the same engine takes them with SolverSettings::converged(), after six seconds on
/// open ground: root of the mean square, and maximum, m. It shows how well an engine solves its equations, not which
/// equations those are.
struct Deviation {
  double rms = 0, max = 0;
};
Deviation deviation(const Engine& engine);

}  // namespace muro::bench
