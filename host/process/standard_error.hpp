// SPDX-License-Identifier: MIT
#pragma once

namespace muro::host {

/// From now on what cannot be printed to standard error is lost without a failure: a run does not end because nobody
/// reads its notes any more. To be called where SIGPIPE is ignored.
void lose_what_standard_error_refuses();

}  // namespace muro::host
