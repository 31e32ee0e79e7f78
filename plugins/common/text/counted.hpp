// SPDX-License-Identifier: MIT
// Numbers of things in messages.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

namespace muro {

/// "1 number", "2 numbers": of what gets an s when there are several.
inline std::string counted(std::uint64_t count, std::string_view what) {
  return std::to_string(count).append(1, ' ').append(what).append(count == 1 ? "" : "s");
}

}  // namespace muro
