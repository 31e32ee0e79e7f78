// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "host/commands/commands.hpp"
#include "host/commands/model_check/model_check.hpp"

namespace muro::host {

/// Returns lines that say how each installed motion would serve the robots of each template. The scenario is built once
/// for each of them. A motion keeps `base: fixed` if it knows this parameter; other parameters are left out.
std::vector<std::string> level_lines(const ScenarioOptions& options, const BuiltScenario& built, Registry& registry,
                                     Length length);

}  // namespace muro::host
