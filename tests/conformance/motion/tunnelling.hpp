// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "tests/conformance/motion/case.hpp"

namespace muro::conformance {

/// Returns the largest speed up to which a ball of 0.1 m does not pass through a wall of `thickness` (m; 0: the ground
/// plane) at 1000 Hz, wherever in a step the impact is, m/s. Infinite if it does not pass at 10 km/s. `motion`: one by
/// forces, or motion.point.
double tunnelling_speed(const std::string& motion, double thickness);

}  // namespace muro::conformance
