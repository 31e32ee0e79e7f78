// SPDX-License-Identifier: MIT
// Lists in the arguments of control code: words or numbers between blanks and commas.
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

namespace quadruped {

/// Calls `take` for each word of a text.
template <class Take>
void for_words(std::string_view text, Take take) {
  for (std::size_t at = text.find_first_not_of(" ,"); at != text.npos;) {
    const std::size_t end = std::min(text.find_first_of(" ,", at), text.size());
    take(text.substr(at, end - at));
    at = text.find_first_not_of(" ,", end);
  }
}

/// Returns the number; nothing when the word is not wholly a finite number.
inline std::optional<double> number_of(std::string_view word) {
  double number = 0;
  const char* const end = word.data() + word.size();
  const auto read = std::from_chars(word.data(), end, number);
  if (read.ec != std::errc() || read.ptr != end || !std::isfinite(number)) return std::nullopt;
  return number;
}

}  // namespace quadruped
