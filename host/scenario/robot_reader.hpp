// SPDX-License-Identifier: MIT
#pragma once

#include <vector>

#include "host/scenario/problems.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// Reads all templates of `robots`.
std::vector<RobotTemplate> read_robots(const Node& robots, Problems& problems);

}  // namespace muro::host
