// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "host/outputs/output_options.hpp"
#include "host/scenario/features/unsupported_features.hpp"
#include "host/tools/compare/contact_monitor.hpp"
#include "host/tools/compare/factor.hpp"
#include "host/tools/compare/trajectory.hpp"

namespace muro::host {

struct BuiltScenario;

/// The cost of a run in s per simulated second. It depends on the machine.
struct Cost {
  double total = 0;    ///< of the run, wall-clock time
  double varied = 0;   ///< of the algorithms that are varied
  double contact = 0;  ///< of collision detection and contact forces, outside of the motions
};

/// The result of one variation.
struct VariationResult {
  std::string label;
  std::string failure;  ///< why it cannot run or ended early, line by line; empty: it ran
  Cost cost;
  std::optional<Trajectory> trajectory;
  std::optional<double> first_contact;  ///< s; none: there was none
  std::optional<std::size_t> contacts;  ///< that began; none: no force moves the robots, or there is no monitor
  std::vector<std::string> notes;       ///< of readers and defaults
  std::vector<UnsupportedFeatures> unsupported;
  std::string no_monitor;  ///< why contacts are not monitored; empty: they are
  bool repeatable = true;  ///< the second run ended in the same state as the first
};

/// What all variations of a comparison share.
struct Comparison {
  Scenario scenario;  ///< without variations
  std::vector<std::string> overrides;
  std::optional<std::uint64_t> seed;
  std::vector<Factor> factors;
  double duration = 0;                ///< s
  std::vector<std::uint32_t> robots;  ///< numbers of those that are compared
  OutputOptions outputs{};            ///< files of the results
};

/// Reads the scenario of the comparison with these overrides, without recorders and views.
Scenario read_variation(const Comparison& comparison, const std::vector<std::string>& overrides,
                        const Registry& registry);

/// A variation in a fresh state, on one thread, without clients. `log` gets the messages of algorithms. Throws what
/// prevents it, and OutputError when an output of the comparison would overwrite what the variation reads.
BuiltScenario build_variation(const Comparison& comparison, const Variation& variation, Registry& registry,
                              const std::function<void(LogLevel, std::string_view)>& log);

/// Runs a variation twice, each time from a fresh state and on one thread: once to record what robots do, and once to
/// measure the cost, because recording takes time too. What prevents a run is in `failure`. `log` gets the messages of
/// algorithms. Throws OutputError when an output of the comparison would overwrite what the variation reads.
VariationResult run_variation(const Comparison& comparison, const Variation& variation, Registry& registry,
                              const std::function<void(LogLevel, std::string_view)>& log);

/// Numbers of the robots that the factors name; all of the scene when they name none.
std::vector<std::uint32_t> robots_of(const Scenario& scenario, const std::vector<Factor>& factors);

}  // namespace muro::host
