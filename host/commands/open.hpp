// SPDX-License-Identifier: MIT
#pragma once

#include "host/commands/commands.hpp"
#include "host/scenario/builder.hpp"

namespace muro::host {

/// Reads and builds a scenario; prints what its readers noted to standard error.
/// `more`: as for build().
BuiltScenario open_scenario(const ScenarioOptions& options, Registry& registry,
                            const std::function<void(Simulation&)>& more = {});

}  // namespace muro::host
