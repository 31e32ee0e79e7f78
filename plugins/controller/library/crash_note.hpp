// SPDX-License-Identifier: MIT
// Notes that a process of control code leaves when a signal ends it.
#pragma once

#include "shared_layout.hpp"

namespace muro::control {

/// Makes this process write the stack of calls to the socket before a signal ends it, and on SIGALRM. [main]
void leave_crash_notes();

/// Also writes the signal and the address to shared memory.
void leave_crash_notes_in(SharedHeader& header);

/// Limits the address space of this process to its present size plus `bytes`. Has no effect with a sanitizer, which
/// needs more memory.
void bound_memory(std::uint64_t bytes);

}  // namespace muro::control
