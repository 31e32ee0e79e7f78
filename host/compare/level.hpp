// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/compare/track.hpp"
#include "host/compare/vary.hpp"
#include "host/compare/witness.hpp"
#include "host/unsupported_features/unsupported_features.hpp"

namespace muro::host {

/// What a run costs, s per simulated second. It depends on the machine.
struct Cost {
  double whole = 0;    ///< of the run, on the wall
  double varied = 0;   ///< of the algorithms that are varied
  double contact = 0;  ///< of collision detection and contact forces, outside of the motions
};

/// One variation, and what came of it.
struct Level {
  std::string label;
  std::string failure;  ///< why it cannot run or ended early, line by line; empty: it ran
  Cost cost;
  std::optional<Track> track;
  std::optional<double> first_contact;  ///< s; none: there was none
  std::optional<std::size_t> contacts;  ///< that began; none: no force moves the robots, or nobody looked
  std::vector<std::string> notes;       ///< of readers and defaults
  std::vector<Losses> losses;
  std::string blind;       ///< why contacts were not looked at; empty: they were
  bool repeatable = true;  ///< the second run ended as the first
};

/// What all levels of a comparison share.
struct Comparison {
  Scenario scenario;  ///< as it is, without variations
  std::vector<std::string> overrides;
  std::optional<std::uint64_t> seed;
  std::vector<Variety> varieties;
  double duration = 0;                ///< s
  std::vector<std::uint32_t> robots;  ///< numbers of those that are compared
};

/// Reads the scenario of the comparison with these overrides, without recorders and views.
Scenario read_level(const Comparison& comparison, const std::vector<std::string>& overrides, const Registry& registry);

/// Runs a variation twice, each time from a fresh state and on one thread: to see what robots do, and to see what it
/// costs, which is not measured where it is looked at. What prevents a run is in `failure`.
Level run_level(const Comparison& comparison, const Variation& variation, Registry& registry);

/// Numbers of the robots that the varieties name; all of the scene when they name none.
std::vector<std::uint32_t> robots_of(const Scenario& scenario, const std::vector<Variety>& varieties);

}  // namespace muro::host
