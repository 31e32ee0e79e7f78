// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "muro_controller.h"

namespace muro::control {

/// Size of the first table of this ABI, in bytes. Every library has at least these fields.
inline constexpr std::uint32_t first_table_size = 88;

/// Throws Error when something is wrong with the table. `path`: path of the library, for the message.
void check_table(const muro_controller_table* table, const std::string& path);

}  // namespace muro::control
