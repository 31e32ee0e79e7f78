// SPDX-License-Identifier: MIT
#pragma once

namespace muro::host {

/// Makes signals that end the process (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) write one line to standard error
/// first: algorithm, robot, library and simulated time of the thread's present call. The stack of calls follows. Then
/// the process ends by that signal, as without this function. For the program only: a process that embeds muro has its
/// own handlers.
void report_crashes();

/// Writes the stack of calls of this thread to standard error. May be called in signal handlers after report_crashes
/// was called.
void write_stack();

}  // namespace muro::host
