// SPDX-License-Identifier: MIT
#pragma once

#include "drives.hpp"

namespace muro::mjcf {

/// Reports by name what robots and worlds do not have: tendons, equality constraints, sensors, ...
void report_left_out(const mjModel& m, const Source& source, const Drives& drives, Problems& problems);

}  // namespace muro::mjcf
