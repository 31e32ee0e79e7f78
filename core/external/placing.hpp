// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "muro/ext/run_control.hpp"

namespace muro {

class World;

/// Returns the objects that a robot, or an object that moves, would overlap at its new place, as the end of a sentence:
/// "`wall` by 0.2 m". Empty: there is no overlap.
using OverlapCheck = std::function<std::string(const Placement&)>;

/// Returns why a placement is not possible in `world`: names the object and the allowed values. Empty: it is possible.
std::string problem_of(const World& world, const Placement& placement);

/// Writes pose and twist. Call only after problem_of has found no problem.
void write_placement(World& world, const Placement& placement);

}  // namespace muro
