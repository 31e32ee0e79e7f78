// SPDX-License-Identifier: MIT
#include "host/compare/level.hpp"

#include <algorithm>
#include <chrono>
#include <set>

#include "core/instance.hpp"
#include "host/report.hpp"

namespace muro::host {

namespace {

constexpr double longest_warm_up = 1;  ///< s, simulated

std::int64_t ns(double seconds) { return std::llround(seconds * 1e9); }

/// Which part of the cost of an instance is that of the varied algorithms.
double varied_part(const AlgorithmSetup& s, const Description& d, const Comparison& comparison,
                   const Variation& variation) {
  for (std::size_t v = 0; v < comparison.varieties.size(); ++v) {
    const Variety& variety = comparison.varieties[v];
    const bool world = (d.capabilities & Capability::world) != 0;  // one for robots of several templates, or subsystems
    if (s.use != variation.choices[v]->use || (s.subsystem != variety.subsystem && !world)) continue;
    if (variety.robots.empty()) return 1;
    const std::size_t own = std::size_t(std::count_if(s.items.begin(), s.items.end(), [&](const Item& item) {
      return item.robot && std::binary_search(comparison.robots.begin(), comparison.robots.end(), item.robot->number);
    }));
    if (own > 0) return double(own) / double(s.items.size());
  }
  return 0;
}

/// Seconds so far; `whole` is the sum of all algorithms.
Cost cost_so_far(const Simulation& simulation, const Comparison& comparison, const Variation& variation) {
  Cost c;
  for (std::size_t i = 0; i < simulation.instances().size(); ++i) {
    const Instance& instance = *simulation.instances()[i];
    const Kind kind = instance.description().kind;
    const double seconds =
        double(simulation.scheduler().cost(simulation.task_of(i)).ticks) * simulation.scheduler().seconds_per_tick();
    const double part = varied_part(instance.setup(), instance.description(), comparison, variation);
    c.whole += seconds;
    c.varied += part * seconds;
    if (part == 0 && (kind == Kind::collision || kind == Kind::contact)) c.contact += seconds;
  }
  return c;
}

/// None where nobody can look; `why` then says so.
std::unique_ptr<Witness> witness_of(Simulation& simulation, const Comparison& comparison, std::string& why) {
  try {
    return std::make_unique<Witness>(simulation, comparison.robots, comparison.scenario.algorithms);
  } catch (const SetupError& e) {
    why = e.what();
    return nullptr;
  }
}

/// Runs to the end, and on the way looks where robots are and whom they touch.
void observe(Simulation& simulation, const Comparison& comparison, Level& level) {
  const std::int64_t end = ns(comparison.duration);
  Track track(comparison.robots);
  const Odometer odometer(simulation);
  const std::unique_ptr<Witness> witness = witness_of(simulation, comparison, level.blind);
  const bool looks = witness && witness->counts();
  track.look(simulation);
  if (looks) witness->look();
  const std::int64_t pause = looks ? Witness::period : Odometer::period;
  while (simulation.now() < end) {
    simulation.run_until(std::min(end, simulation.now() - simulation.now() % pause + pause));
    if (looks) witness->look();
    if (simulation.now() % Odometer::period != 0 && simulation.now() < end) continue;
    odometer.check();
    track.look(simulation);
  }
  level.track = std::move(track);
  if (!looks) return;
  level.contacts = witness->begins();
  level.first_contact = witness->first_begin();
}

void measure(Simulation& simulation, const Comparison& comparison, const Variation& variation, Level& level) {
  const std::int64_t begin = ns(std::min(longest_warm_up, comparison.duration / 4)), end = ns(comparison.duration);
  simulation.run_until(begin);
  const Cost before = cost_so_far(simulation, comparison, variation);
  const auto start = std::chrono::steady_clock::now();
  simulation.run_until(end);
  const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  const Cost after = cost_so_far(simulation, comparison, variation);
  const double simulated = 1e-9 * double(end - begin), sum = after.whole - before.whole;
  // Calls are sampled, so that their sum may come out longer than the run in which they were made, one by one.
  const double scale = std::min(1.0, wall / std::max(sum, 1e-12)) / simulated;
  level.cost = {wall / simulated, (after.varied - before.varied) * scale, (after.contact - before.contact) * scale};
}

BuiltScenario build_level(const Comparison& comparison, const Variation& variation, Registry& registry) {
  BuiltScenario built = build(read_level(comparison, variation.overrides, registry), registry);
  built.simulation->set_threads(1);
  return built;
}

}  // namespace

Scenario read_level(const Comparison& comparison, const std::vector<std::string>& overrides, const Registry& registry) {
  std::vector<std::string> all = comparison.overrides;
  all.insert(all.end(), overrides.begin(), overrides.end());
  Scenario s = read_scenario(comparison.scenario.file, all);
  if (comparison.seed) s.seed = *comparison.seed;
  std::set<std::string> gone;
  std::erase_if(s.algorithms, [&](const Subsystem& a) {
    const auto offer = std::find_if(registry.catalog().begin(), registry.catalog().end(),
                                    [&](const CatalogEntry& o) { return o.id == a.use; });
    const bool writes = offer != registry.catalog().end() &&
                        (offer->kind == name_of(Kind::recorder) || offer->kind == name_of(Kind::view));
    if (writes) gone.insert(a.name);
    return writes;
  });
  for (auto& sequence : s.sequences) std::erase_if(sequence, [&](const Name& n) { return gone.count(n.text) > 0; });
  std::erase_if(s.sequences, [](const auto& sequence) { return sequence.size() < 2; });
  return s;
}

Level run_level(const Comparison& comparison, const Variation& variation, Registry& registry) {
  Level level;
  level.label = variation.label;
  try {
    std::uint64_t seen = 0;
    {
      const BuiltScenario built = build_level(comparison, variation, registry);
      level.notes = built.notes;
      for (Losses& l : losses_of(built))
        if (std::any_of(comparison.varieties.begin(), comparison.varieties.end(),
                        [&](const Variety& v) { return v.robots == l.robots; }))
          level.losses.push_back(std::move(l));
      observe(*built.simulation, comparison, level);
      seen = built.simulation->state_hash();
    }
    const BuiltScenario built = build_level(comparison, variation, registry);
    built.simulation->set_log([](LogLevel, std::string_view) {});  // it has been said
    measure(*built.simulation, comparison, variation, level);
    level.repeatable = seen == built.simulation->state_hash();
  } catch (const std::exception& e) {
    level.failure = e.what();
  }
  return level;
}

std::vector<std::uint32_t> robots_of(const Scenario& scenario, const std::vector<Variety>& varieties) {
  std::set<std::uint32_t> some, all;
  std::uint32_t number = 0;
  for (const RobotTemplate& t : scenario.robots)
    for (int i = 0; i < int(t.subsystems.size()); ++i, ++number) {
      all.insert(number);
      for (const Variety& v : varieties) {
        const std::vector<Subsystem>& own = t.subsystems[std::size_t(i)];
        if (v.robots == t.name && v.first <= i && i <= v.last &&
            std::any_of(own.begin(), own.end(), [&](const Subsystem& s) { return s.name == v.subsystem; }))
          some.insert(number);
      }
    }
  const std::set<std::uint32_t>& chosen = some.empty() ? all : some;
  return {chosen.begin(), chosen.end()};
}

}  // namespace muro::host
