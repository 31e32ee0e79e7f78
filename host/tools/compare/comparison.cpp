// SPDX-License-Identifier: MIT
#include "host/tools/compare/comparison.hpp"

#include <algorithm>
#include <chrono>
#include <set>

#include "core/instance.hpp"
#include "core/output_registry.hpp"
#include "host/outputs/remove_outputs.hpp"
#include "host/outputs/report.hpp"

namespace muro::host {

namespace {

constexpr double max_warm_up = 1;  ///< s, simulated

std::int64_t ns(double seconds) { return std::llround(seconds * 1e9); }

/// Fraction of the cost of an instance that belongs to the varied algorithms.
double varied_fraction(const AlgorithmSetup& s, const Description& d, const Comparison& comparison,
                       const Variation& variation) {
  for (std::size_t v = 0; v < comparison.factors.size(); ++v) {
    const Factor& factor = comparison.factors[v];
    const bool world = (d.capabilities & Capability::world) != 0;  // serves robots of several templates
    if (s.use != variation.choices[v]->use || (s.subsystem != factor.subsystem && !world)) continue;
    if (factor.robots.empty()) return 1;
    const std::size_t own = std::size_t(std::count_if(s.items.begin(), s.items.end(), [&](const Item& item) {
      return item.robot &&
             std::binary_search(comparison.robots.begin(), comparison.robots.end(), index_of(item.robot->id));
    }));
    if (own > 0) return double(own) / double(s.items.size());
  }
  return 0;
}

/// Returns the seconds so far; `total` is the sum over all algorithms.
Cost cost_so_far(const Simulation& simulation, const Comparison& comparison, const Variation& variation) {
  Cost c;
  for (std::size_t i = 0; i < simulation.instances().size(); ++i) {
    const Instance& instance = *simulation.instances()[i];
    const Kind kind = instance.description().kind;
    const double seconds =
        double(simulation.scheduler().cost(simulation.task_of(i)).ticks) * simulation.scheduler().seconds_per_tick();
    const double fraction = varied_fraction(instance.setup(), instance.description(), comparison, variation);
    c.total += seconds;
    c.varied += fraction * seconds;
    if (fraction == 0 && (kind == Kind::collision || kind == Kind::contact)) c.contact += seconds;
  }
  return c;
}

/// Returns null when it cannot be created; `reason` then gets the reason.
std::unique_ptr<ContactMonitor> make_monitor(Simulation& simulation, const Comparison& comparison,
                                             std::string& reason) {
  try {
    return std::make_unique<ContactMonitor>(simulation, comparison.robots, comparison.scenario.algorithms);
  } catch (const SetupError& e) {
    reason = e.what();
    return nullptr;
  }
}

/// Runs to the end, and records poses and contacts.
void record(Simulation& simulation, const Comparison& comparison, VariationResult& result) {
  const std::int64_t end = ns(comparison.duration);
  Trajectory trajectory(comparison.robots);
  const Odometer odometer(simulation);
  const std::unique_ptr<ContactMonitor> monitor = make_monitor(simulation, comparison, result.no_monitor);
  const bool monitors = monitor && monitor->is_active();
  trajectory.sample(simulation);
  if (monitors) monitor->update();
  const std::int64_t period = monitors ? ContactMonitor::period : Odometer::period;
  while (simulation.now() < end && !simulation.stopped()) {
    simulation.run_until(std::min(end, simulation.now() - simulation.now() % period + period));
    if (monitors) monitor->update();
    if (simulation.now() % Odometer::period != 0 && simulation.now() < end) continue;
    odometer.check();
    trajectory.sample(simulation);
  }
  result.trajectory = std::move(trajectory);
  if (!monitors) return;
  result.contacts = monitor->contacts();
  result.first_contact = monitor->first_contact();
}

void measure(Simulation& simulation, const Comparison& comparison, const Variation& variation,
             VariationResult& result) {
  const std::int64_t begin = ns(std::min(max_warm_up, comparison.duration / 4)), end = ns(comparison.duration);
  simulation.run_until(begin);
  const Cost before = cost_so_far(simulation, comparison, variation);
  const auto start = std::chrono::steady_clock::now();
  simulation.run_until(end);
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Cost after = cost_so_far(simulation, comparison, variation);
  const double simulated = 1e-9 * double(end - begin), sum = after.total - before.total;
  // Only some calls are timed, so the extrapolated sum can exceed the duration of the run.
  const double scale = std::min(1.0, wall / std::max(sum, 1e-12)) / simulated;
  result.cost = {wall / simulated, (after.varied - before.varied) * scale, (after.contact - before.contact) * scale};
}

using Log = std::function<void(LogLevel, std::string_view)>;

}  // namespace

Scenario read_variation(const Comparison& comparison, const std::vector<std::string>& overrides,
                        const Registry& registry) {
  std::vector<std::string> all = comparison.overrides;
  all.insert(all.end(), overrides.begin(), overrides.end());
  Scenario s = read_scenario(comparison.scenario.file, all);
  if (comparison.seed) s.seed = *comparison.seed;
  remove_outputs(s, registry);
  return s;
}

BuiltScenario build_variation(const Comparison& comparison, const Variation& variation, Registry& registry,
                              const Log& log) {
  BuiltScenario built =
      build(read_variation(comparison, variation.overrides, registry), registry, [&](Simulation& simulation) {
        simulation.set_log(log);
        simulation.keep_inputs_closed();
        add_outputs(simulation, comparison.outputs);
      });
  built.simulation->set_threads(1);
  return built;
}

VariationResult run_variation(const Comparison& comparison, const Variation& variation, Registry& registry,
                              const Log& log) {
  VariationResult result;
  result.label = variation.label;
  try {
    std::uint64_t recorded_hash = 0;
    {
      const BuiltScenario built = build_variation(comparison, variation, registry, log);
      result.notes = built.notes;
      for (UnsupportedFeatures& u : find_unsupported_features(built))
        if (std::any_of(comparison.factors.begin(), comparison.factors.end(),
                        [&](const Factor& f) { return f.robots == u.robots; }))
          result.unsupported.push_back(std::move(u));
      record(*built.simulation, comparison, result);
      recorded_hash = built.simulation->state_hash();
    }
    // the first run has logged the messages
    const BuiltScenario built = build_variation(comparison, variation, registry, [](LogLevel, std::string_view) {});
    measure(*built.simulation, comparison, variation, result);
    result.repeatable = recorded_hash == built.simulation->state_hash();
  } catch (const OutputError&) {
    throw;
  } catch (const std::exception& e) {
    result.failure = e.what();
  }
  return result;
}

std::vector<std::uint32_t> robots_of(const Scenario& scenario, const std::vector<Factor>& factors) {
  std::set<std::uint32_t> named, all;
  std::uint32_t number = 0;
  for (const RobotTemplate& t : scenario.robots)
    for (int i = 0; i < int(t.subsystems.size()); ++i, ++number) {
      all.insert(number);
      for (const Factor& f : factors) {
        const std::vector<Subsystem>& own = t.subsystems[std::size_t(i)];
        if (f.robots == t.name && f.first <= i && i <= f.last &&
            std::any_of(own.begin(), own.end(), [&](const Subsystem& s) { return s.name == f.subsystem; }))
          named.insert(number);
      }
    }
  const std::set<std::uint32_t>& chosen = named.empty() ? all : named;
  return {chosen.begin(), chosen.end()};
}

}  // namespace muro::host
