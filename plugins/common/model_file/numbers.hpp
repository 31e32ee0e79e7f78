// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <charconv>
#include <cmath>
#include <string>
#include <string_view>
#include <vector>

namespace muro::model_file {

/// Numbers separated by white space, in any locale written with a decimal point. On failure `trouble`
/// completes a sentence that begins with the text: "`1,5` is no number; ...".
inline std::vector<double> parse_numbers(std::string_view text, std::string& trouble) {
  constexpr std::string_view blanks = " \t\r\n";
  std::vector<double> values;
  std::size_t at = 0;
  while ((at = text.find_first_not_of(blanks, at)) != std::string_view::npos) {
    const std::size_t end = std::min(text.find_first_of(blanks, at), text.size());
    std::string_view word = text.substr(at, end - at);
    at = end;
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0;
    const auto [rest, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    const bool whole = rest == word.data() + word.size();
    if (error == std::errc::result_out_of_range && whole) {
      // a number too small for a double is zero
      long double wide = 1;
      std::from_chars(word.data(), word.data() + word.size(), wide);
      if (std::abs(wide) >= 1) trouble = "is out of the range of a number; the largest is 1.8e308";
    } else if (error != std::errc() || !whole) {
      trouble = word.find(',') != word.npos ? "is no number; the decimal sign is a point, and blanks separate numbers"
                                            : "is no number; write it like 0.05 or 5e-2";
    } else if (!std::isfinite(value)) {
      trouble = "is not finite";
    }
    if (!trouble.empty()) return {};
    values.push_back(value);
  }
  return values;
}

}  // namespace muro::model_file
