// SPDX-License-Identifier: MIT
#pragma once

#include "core/registry.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// Removes recorders and views from a scenario, also from its sequences: for commands that write only the requested
/// files.
void remove_outputs(Scenario& scenario, const Registry& registry);

}  // namespace muro::host
