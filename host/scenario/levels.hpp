// SPDX-License-Identifier: MIT
// Levels of detail of a robot that is handed over between several motions:
//
//     motion:
//       levels: {far: {use: motion.point}, near: {use: motion.ode}}
//       start: far
//       rules: [near when nearer than 2 to ball, far when farther than 3 from ball]
#pragma once

#include <string>
#include <vector>

#include "host/scenario/problems.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// Whether the subsystem lists levels.
bool has_levels(const Node& node);

/// Returns a subsystem for each level, and one for the rules if there are any.
std::vector<Subsystem> read_levels(const std::string& name, const Node& node, const std::string& owner,
                                   Problems& problems);

}  // namespace muro::host
