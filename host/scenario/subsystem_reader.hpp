// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "host/scenario/problems.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// Whether the node is a subsystem or a scene-wide algorithm: a map with `use`, or with `levels`.
bool is_subsystem(const Node& node);

/// Reads a subsystem with `use`; `owner` names its owner in messages.
Subsystem read_subsystem(const std::string& name, const Node& node, const std::string& owner, Problems& problems);

}  // namespace muro::host
