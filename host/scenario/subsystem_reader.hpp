// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "host/scenario/problems.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// Whether the node is a subsystem or a scene-wide algorithm: a map with `use`, or with `levels`.
bool is_subsystem(const Node& node);

/// Reads one with `use`; `owner` names in messages what it belongs to.
Subsystem read_subsystem(const std::string& name, const Node& node, const std::string& owner, Problems& problems);

}  // namespace muro::host
