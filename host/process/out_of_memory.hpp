// SPDX-License-Identifier: MIT
#pragma once

namespace muro::host {

inline constexpr const char* lack_of_memory = "the scene needs more memory than there is; make it smaller";

/// Makes a lack of memory in a call that cannot throw end the program, with a line that says so and exit code 2, as in
/// a call that throws. For the program only.
void report_lack_of_memory();

}  // namespace muro::host
