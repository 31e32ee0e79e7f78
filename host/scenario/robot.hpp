// SPDX-License-Identifier: MIT
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "host/scenario/scenario.hpp"
#include "host/scenario/section.hpp"

namespace muro::host {

/// Whether this is a subsystem or a scene-wide algorithm: a map that says `use`, or `levels`.
bool is_subsystem(const Node& n);

/// Reads one; `owner` names in messages what it belongs to.
Subsystem read_subsystem(const std::string& name, const Node& n, const std::string& owner, Problems& problems);

/// Reads all templates of `robots`.
std::vector<RobotTemplate> read_robots(const Node& robots, Problems& problems);

}  // namespace muro::host
