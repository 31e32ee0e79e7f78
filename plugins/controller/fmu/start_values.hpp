// SPDX-License-Identifier: MIT
#pragma once

#include "component.hpp"
#include "mapping.hpp"

namespace muro::fmu {

/// Arrays get the sizes that they have with these values of structural parameters. Throws Error where such a value is
/// no length, or an array is too long.
void set_sizes(ModelDescription& description, const StartValues& values);

/// Gives an instance before its initialization the values that a scenario says, structural parameters first, in
/// configuration mode: numbers as of read_numbers(), texts, binary data as hexadecimal digits. Throws Error.
void set_start_values(Component& component, const ModelDescription& description, const StartValues& values);

}  // namespace muro::fmu
