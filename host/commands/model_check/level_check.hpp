// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "host/commands/commands.hpp"
#include "host/commands/model_check/model_check.hpp"

namespace muro::host {

/// How each motion that is installed would serve the robots of each template: the scenario is built once for each of
/// them. A motion keeps `base: fixed` where it knows it; other parameters are left out.
std::vector<std::string> level_lines(const ScenarioOptions& options, const BuiltScenario& built, Registry& registry,
                                     Length length);

}  // namespace muro::host
