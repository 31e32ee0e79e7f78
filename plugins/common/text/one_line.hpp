// SPDX-License-Identifier: MIT
// Texts of other libraries, in messages.
#pragma once

#include <string>
#include <string_view>

#include "muro/base/printable.hpp"

namespace muro {

/// Converts a text of another library, maybe with pieces of a file in it, for a message: printable, in one line of
/// bounded length.
inline std::string one_line(std::string_view text) {
  constexpr std::size_t max = 400;
  std::string words;
  for (const char c : text) {
    const bool blank = c == '\n' || c == '\r' || c == '\t' || c == ' ';
    if (!blank)
      words += c;
    else if (!words.empty() && words.back() != ' ')
      words += ' ';
  }
  while (!words.empty() && words.back() == ' ') words.pop_back();
  return shortened(printable(words), max);
}

}  // namespace muro
