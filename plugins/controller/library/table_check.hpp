// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "muro_controller.h"

namespace muro::control {

/// The size of the first table of this ABI: every library has at least its fields.
inline constexpr std::uint32_t first_table_size = 88;

/// Throws Error when something is wrong with the table; `path` is the library's, for the message.
void check_table(const muro_controller_table* table, const std::string& path);

}  // namespace muro::control
