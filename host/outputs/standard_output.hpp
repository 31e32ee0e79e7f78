// SPDX-License-Identifier: MIT
#pragma once

namespace muro::host {

/// Opens standard streams that were closed at the start of the program, so that no file gets their numbers and nothing
/// is printed into it. To be called first.
void keep_standard_streams();

/// Whether printed text was lost, as on a full disk.
bool standard_output_failed();

/// Writes the text that is still in memory. Returns the exit code: that of the command, or 1 when it was 0 and standard
/// output has failed; the reason is then reported on standard error. A pipe whose reader has left ends the program
/// silently, as SIGPIPE would have.
int close_standard_output(int exit_code);

}  // namespace muro::host
