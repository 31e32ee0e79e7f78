// SPDX-License-Identifier: MIT
#pragma once

#include <functional>

#include "component.hpp"

namespace muro::fmu {

/// Throws Error when an FMU does not allow communication steps of `size` s. The message has allowed rates.
void check_step_size(const ModelDescription& description, double size);

/// Returns advice for the user about communication steps of `size` s; "" when there is none.
std::string advice_on_step_size(const ModelDescription& description, double size);

/// Advances an instance from `begin` to `end` (s); `size` is the difference. Uses one communication step, or several
/// when the FMU returns early or discards a step. `set_inputs` sets the inputs again after a return to an earlier
/// state. Throws Error when the FMU does not reach `end`, with the reason and the flag that would allow it.
void advance(Component& component, const ModelDescription& description, double begin, double end, double size,
             const std::function<void()>& set_inputs);

}  // namespace muro::fmu
