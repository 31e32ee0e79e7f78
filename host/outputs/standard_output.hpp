// SPDX-License-Identifier: MIT
#pragma once

namespace muro::host {

/// To be called first: where the program was started with closed standard streams, no file gets their numbers, so that
/// nothing is printed into it.
void keep_standard_streams();

/// Whether something that was printed has not arrived, as on a full disk.
bool standard_output_failed();

/// Brings out what is still in memory. Returns the exit code: that of the command, or, when it was 0 and standard
/// output has failed, 1; then the reason is told on standard error. A pipe whose reader has left ends the program
/// silently, as SIGPIPE would have.
int close_standard_output(int exit_code);

}  // namespace muro::host
