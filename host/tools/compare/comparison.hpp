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
  double total = 0;    ///< wall-clock time of the run
  double varied = 0;   ///< cost of the varied algorithms
  double contact = 0;  ///< cost of collision detection and contact forces, outside of the motions
};

/// The result of one variation.
struct VariationResult {
  std::string label;
  std::string failure;  ///< reason why it cannot run or ended early, in lines; empty: it ran to its end
  Cost cost;
  std::optional<Trajectory> trajectory;
  std::optional<double> first_contact;  ///< s; empty: there was no contact
  std::optional<std::size_t> contacts;  ///< contacts that began; empty: no force moves the robots, or no monitor
  std::vector<std::string> notes;       ///< notes of readers and defaults
  std::vector<UnsupportedFeatures> unsupported;
  std::string no_monitor;  ///< reason why contacts are not monitored; empty: they are
  bool repeatable = true;  ///< the second run ended in the same state as the first
};

/// Data that all variations of a comparison share.
struct Comparison {
  Scenario scenario;  ///< without variations
  std::vector<std::string> overrides;
  std::optional<std::uint64_t> seed;
  std::vector<Factor> factors;
  double duration = 0;                ///< s
  std::vector<std::uint32_t> robots;  ///< numbers of the compared robots
  OutputOptions outputs{};            ///< files of the results
};

/// Reads the scenario of the comparison with these overrides, without recorders and views.
Scenario read_variation(const Comparison& comparison, const std::vector<std::string>& overrides,
                        const Registry& registry);

/// Builds a variation in a fresh state, on one thread, without clients. `log` gets the messages of algorithms. Throws
/// the error that prevents it, and OutputError when an output of the comparison would overwrite one of its inputs.
BuiltScenario build_variation(const Comparison& comparison, const Variation& variation, Registry& registry,
                              const std::function<void(LogLevel, std::string_view)>& log);

/// Runs a variation twice, each time from a fresh state and on one thread: once to record the motion of the robots, and
/// once to measure the cost, because recording takes time too. An error that prevents a run is in `failure`. `log` gets
/// the messages of algorithms. Throws OutputError when an output of the comparison would overwrite one of its inputs.
VariationResult run_variation(const Comparison& comparison, const Variation& variation, Registry& registry,
                              const std::function<void(LogLevel, std::string_view)>& log);

/// Returns the numbers of the robots that the factors name; all robots of the scene when they name none.
std::vector<std::uint32_t> robots_of(const Scenario& scenario, const std::vector<Factor>& factors);

}  // namespace muro::host
