// SPDX-License-Identifier: MIT
// Drives of teams through the city, for time and for accuracy.
#pragma once

#include <vector>

#include "tests/bench/peers/team.hpp"

namespace muro::bench {

/// How long an engine runs: fresh cities, each with a new seed, and in each of them timed turns behind a warm-up as
/// long as one. Runs are short, for vehicles that drive blindly end up at walls; the slowest engine takes some seconds
/// in all. What a turn computes is the same each time, and a disturbed machine can only take longer: of `repeats`
/// drives through a city, the fastest of each turn counts.
struct Plan {
  int cities, turns, intervals, repeats = 1;
  static Plan for_team(int vehicles) {
    if (vehicles >= 1000) return {1, 5, 2};
    if (vehicles >= 100) return {1, 5, 8};
    return vehicles >= 10 ? Plan{3, 2, 20} : Plan{10, 2, 20};
  }
  double simulated() const { return 1e-3 * City::interval * intervals * (turns + 1); }  ///< s in each city
};

/// What was seen of an engine.
struct Record {
  std::vector<double> rates;  ///< vehicle-steps/s of each turn
  double distance = 0;        ///< m, driven by a vehicle in a city, on average
  double height = 0;          ///< m, on average after each turn

  double rate() const;  ///< the median
  /// The median of the ratios to another's rates, turn by turn.
  double gain(const Record& other) const;
};

/// All engines take turns. `make_city`: of a seed.
std::vector<Record> compare(const Plan& plan, const std::vector<Engine>& engines,
                            const std::function<City(std::uint64_t seed)>& make_city);

/// How far vehicles are from where the same engine takes them with Effort::converged(), after six seconds on open
/// ground: root of the mean square, and the most, m. So it says how well an engine solves its equations, not which
/// those are.
struct Deviation {
  double rms = 0, most = 0;
};
Deviation deviation(const Engine& engine);

}  // namespace muro::bench
