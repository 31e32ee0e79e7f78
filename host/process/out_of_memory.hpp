// SPDX-License-Identifier: MIT
#pragma once

namespace muro::host {

inline constexpr const char* lack_of_memory = "the scene needs more memory than there is; make it smaller";

/// From now on a call that may throw nothing, and for which there is no memory, ends the program with a line that says
/// so and exit code 2, as one does that may throw. For the program alone.
void report_lack_of_memory();

}  // namespace muro::host
