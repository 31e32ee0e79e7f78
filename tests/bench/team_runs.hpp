// SPDX-License-Identifier: MIT
// Runs of teams through the city, for time and for accuracy.
#pragma once

#include <vector>

#include "tests/bench/baselines/team.hpp"

namespace muro::bench {

/// How long an engine runs: several cities, each with a new seed, and in each of them timed rounds after a warm-up as
/// long as one. Runs are short, because vehicles that drive blindly end up at walls; the slowest engine takes some
/// seconds in all. A round computes the same each time, and a disturbed machine can only take longer: of `repeats` runs
/// through a city, the fastest of each round counts.
struct RunPlan {
  int cities, rounds, intervals, repeats = 1;
  static RunPlan for_team(int vehicles) {
    if (vehicles >= 1000) return {1, 5, 2};
    if (vehicles >= 100) return {1, 5, 8};
    return vehicles >= 10 ? RunPlan{3, 2, 20} : RunPlan{10, 2, 20};
  }
  double simulated() const { return 1e-3 * City::interval * intervals * (rounds + 1); }  ///< s in each city
};

/// The result for one engine.
struct Measurement {
  std::vector<double> rates;  ///< vehicle-steps/s of each round
  double distance = 0;        ///< m, driven by a vehicle in a city, on average
  double height = 0;          ///< m, on average after each round

  double rate() const;  ///< the median
  /// The median of the ratios to another's rates, round by round.
  double ratio_to(const Measurement& other) const;
};

/// All engines run round by round in turn. `make_city`: from a seed.
std::vector<Measurement> compare(const RunPlan& plan, const std::vector<Engine>& engines,
                                 const std::function<City(std::uint64_t seed)>& make_city);

/// How far vehicles are from where the same engine takes them with SolverSettings::converged(), after six seconds on
/// open ground: root of the mean square, and maximum, m. It measures how well an engine solves its equations, not which
/// equations those are.
struct Deviation {
  double rms = 0, max = 0;
};
Deviation deviation(const Engine& engine);

}  // namespace muro::bench
