// SPDX-License-Identifier: MIT
#pragma once

#include "host/commands/commands.hpp"
#include "host/scenario/builder.hpp"

namespace muro::host {

/// Reads and builds a scenario; prints warnings and notes to standard error. `add_more`: as for build().
BuiltScenario open_scenario(const ScenarioOptions& options, Registry& registry,
                            const std::function<void(Simulation&)>& add_more = {});

}  // namespace muro::host
