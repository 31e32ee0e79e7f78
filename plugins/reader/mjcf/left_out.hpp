// SPDX-License-Identifier: MIT
#pragma once

#include "drives.hpp"

namespace muro::mjcf {

/// Tells by name what the file has and robots and worlds have not: tendons, equality constraints, sensors, ...
void report_left_out(const mjModel& m, const Source& source, const Drives& drives, Problems& problems);

}  // namespace muro::mjcf
