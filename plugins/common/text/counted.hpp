// SPDX-License-Identifier: MIT
// Counts of things in messages.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace muro {

/// Returns "1 number", "2 numbers": for words that get an s in the plural.
inline std::string counted(std::uint64_t count, std::string_view what) {
  return std::to_string(count).append(1, ' ').append(what).append(count == 1 ? "" : "s");
}

}  // namespace muro
