// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "control_instance.hpp"
#include "control_process.hpp"

namespace muro::control {

/// How a call has failed, behind the name of the library: "crashed in `step`: SIGSEGV". `is_isolated`: in a process of
/// its own, which has these limits.
std::string text_of(const Outcome& outcome, bool is_isolated, const ProcessLimits& limits);

}  // namespace muro::control
