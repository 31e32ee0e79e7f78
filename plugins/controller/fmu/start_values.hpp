// SPDX-License-Identifier: MIT
#pragma once

#include "component.hpp"
#include "mapping.hpp"

namespace muro::fmu {

/// Sets the sizes of arrays from these values of structural parameters. Throws Error when such a value is not a valid
/// length, or an array is too long.
void set_sizes(ModelDescription& description, const StartValues& values);

/// Sets values of a scenario in an instance before its initialization; structural parameters first, in configuration
/// mode. Values: numbers (see read_numbers()), texts, binary data as hexadecimal digits. Throws Error.
void set_start_values(Component& component, const ModelDescription& description, const StartValues& values);

}  // namespace muro::fmu
