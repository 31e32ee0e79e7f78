// SPDX-License-Identifier: MIT
// For a process of control code: what it leaves behind when it dies by a signal.
#pragma once

#include "shared_layout.hpp"

namespace muro::control {

/// From now on a signal by which this process dies, and SIGALRM, first writes the stack of calls to the socket. [main]
void leave_crash_notes();

/// Also notes signal and address in shared memory.
void leave_crash_notes_in(SharedHeader& header);

/// Bounds the address space of this process to what it has and `bytes`. Not with a sanitizer, whose own memory is more
/// than that.
void bound_memory(std::uint64_t bytes);

}  // namespace muro::control
