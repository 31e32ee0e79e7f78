// SPDX-License-Identifier: MIT
#pragma once

namespace muro::host {

/// Ignores failures to print to standard error: a run does not end because the reader of its notes has left. To be
/// called when SIGPIPE is ignored.
void lose_what_standard_error_refuses();

}  // namespace muro::host
