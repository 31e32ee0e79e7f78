// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "component.hpp"

namespace muro::fmu {

/// Throws Error when communication steps of `size` seconds are not legal for an FMU, with the rates that are.
void check_step_size(const ModelDescription& description, double size);

/// What a user may want to know about communication steps of `size` seconds; "" where there is nothing.
std::string advice_on_step_size(const ModelDescription& description, double size);

/// Carries an instance from `begin` to `end` (s), `size` later, as one communication step, and where the FMU returns
/// early or discards a step, in several. `set_inputs` sets the inputs again after a return to an earlier state. Throws
/// Error when the FMU does not get there, says why, and names the flag that would allow it.
void advance(Component& component, const ModelDescription& description, double begin, double end, double size,
             const std::function<void()>& set_inputs);

}  // namespace muro::fmu
