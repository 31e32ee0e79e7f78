// SPDX-License-Identifier: MIT
#pragma once

#include <functional>
#include <string>

#include "muro/ext/run_control.hpp"

namespace muro {

class World;

/// What a robot, or an object that moves, would overlap where it is to be put, as the end of a sentence: "`wall` by
/// 0.2 m". Empty: nothing.
using OverlapCheck = std::function<std::string(const Placement&)>;

/// Why a placement is not possible in `world`; empty: it is. Names the object and what is allowed.
std::string problem_of(const World& world, const Placement& placement);

/// Writes pose and twist. Only after problem_of has found nothing.
void write_placement(World& world, const Placement& placement);

}  // namespace muro
