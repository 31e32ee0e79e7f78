// SPDX-License-Identifier: MIT
#pragma once

#include "core/registry.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// Takes recorders and views out of a scenario, also out of its sequences: for commands that write what they are asked
/// for and nothing else.
void remove_outputs(Scenario& scenario, const Registry& registry);

}  // namespace muro::host
