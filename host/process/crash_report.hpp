// SPDX-License-Identifier: MIT
#pragma once

namespace muro::host {

/// From now on a signal by which the process dies (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) first writes one line to
/// standard error: the algorithm, robot, library and simulated time at which its thread is; behind it the stack of
/// calls. The process then dies by that signal, as it would have. For the program alone: a process that embeds muro has
/// handlers of its own.
void report_crashes();

/// Writes the stack of calls of this thread to standard error. May be called in signal handlers once report_crashes has
/// been.
void write_stack();

}  // namespace muro::host
