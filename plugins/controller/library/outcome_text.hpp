// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "control_instance.hpp"
#include "control_process.hpp"

namespace muro::control {

/// Returns how a call has failed, as the end of a sentence: "crashed in `step`: SIGSEGV". `is_isolated`: it ran in a
/// separate process, with these limits.
std::string text_of(const Outcome& outcome, bool is_isolated, const ProcessLimits& limits);

}  // namespace muro::control
