// SPDX-License-Identifier: MIT
#pragma once

#include "host/commands/commands.hpp"
#include "host/scenario/builder.hpp"

namespace muro::host {

/// Reads a scenario; prints problems of plugins to standard error.
Scenario open_file(const ScenarioOptions& options, const Registry& registry,
                   const std::function<void(Node& root)>& complete = {});
/// Builds it; prints warnings and notes to standard error. `add_more`: as in build().
BuiltScenario open_scenario(Scenario scenario, Registry& registry,
                            const std::function<void(Simulation&)>& add_more = {});
/// Reads and builds a scenario for inspection: recorders and views write and show nothing, and it cannot run.
BuiltScenario look_at_scenario(const ScenarioOptions& options, Registry& registry);

}  // namespace muro::host
