// SPDX-License-Identifier: MIT
#include <fmt/format.h>

#include "host/commands/commands.hpp"
#include "host/commands/open.hpp"
#include "host/unsupported_features/unsupported_features.hpp"

namespace muro::host {

BuiltScenario open_scenario(const ScenarioOptions& options, Registry& registry,
                            const std::function<void(Simulation&)>& add_more) {
  for (const std::string& p : registry.problems()) fmt::print(stderr, "warning: {}\n", p);
  Scenario scenario = read_scenario(options.file, options.overrides);
  if (options.seed) scenario.seed = *options.seed;
  BuiltScenario built = build(std::move(scenario), registry, add_more);
  for (const std::string& n : built.notes) fmt::print(stderr, "{}\n", n);
  return built;
}

int check(const ScenarioOptions& options) {
  Registry registry(Registry::search_path(options.plugin_path));
  const BuiltScenario built = open_scenario(options, registry);
  report_unsupported(find_unsupported_features(built), Detail::full, options.strict);
  fmt::print("{}: {} robots, {} objects, {} algorithms: all is connected\n", options.file,
             built.simulation->world().robots().size(), built.simulation->world().object_count(),
             built.simulation->instances().size());
  return 0;
}

}  // namespace muro::host
