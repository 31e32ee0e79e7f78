// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "core/error.hpp"
#include "host/commands/commands.hpp"
#include "host/commands/open.hpp"
#include "host/unsupported_features/unsupported_features.hpp"

namespace muro::host {

Scenario open_file(const ScenarioOptions& options, const Registry& registry) {
  for (const std::string& p : registry.problems()) fmt::print(stderr, "warning: {}\n", p);
  Scenario scenario = read_scenario(options.file, options.overrides);
  if (options.seed) scenario.seed = *options.seed;
  return scenario;
}

BuiltScenario open_scenario(Scenario scenario, Registry& registry, const std::function<void(Simulation&)>& add_more) {
  BuiltScenario built = build(std::move(scenario), registry, add_more);
  for (const std::string& n : built.notes) fmt::print(stderr, "{}\n", message_text(n));
  return built;
}

BuiltScenario look_at_scenario(const ScenarioOptions& options, Registry& registry) {
  return open_scenario(open_file(options, registry), registry, [](Simulation& s) { s.keep_outputs_closed(); });
}

int check(const ScenarioOptions& options) {
  Registry registry(Registry::search_path(options.plugin_path));
  const BuiltScenario built = look_at_scenario(options, registry);
  report_unsupported(built, Detail::full, options.strict);
  fmt::print("{}: {} robots, {} objects, {} algorithms: all is connected\n", options.file,
             built.simulation->world().robots().size(), built.simulation->world().object_count(),
             built.simulation->instances().size());
  return 0;
}

}  // namespace muro::host
