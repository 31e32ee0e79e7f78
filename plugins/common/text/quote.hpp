// SPDX-License-Identifier: MIT
// Names in messages.
#pragma once

#include <string>
#include <string_view>

#include "muro/base/printable.hpp"

namespace muro {

/// Converts a name or value for a message: in backquotes, of bounded length, with control characters as \xHH.
inline std::string quote(std::string_view text) {
  constexpr std::size_t max = 256;
  return "`" + shortened(printable(text), max) + "`";
}

/// Returns "`a`, `b`, `c` and 4 more".
template <class Names>
std::string quoted_list(const Names& names) {
  constexpr std::size_t max = 8;
  std::string text;
  std::size_t count = 0;
  for (const std::string_view name : names)
    if (++count <= max) text += (count > 1 ? ", " : "") + quote(name);
  if (count == 0) return "none";
  return count > max ? text + " and " + std::to_string(count - max) + " more" : text;
}

}  // namespace muro
