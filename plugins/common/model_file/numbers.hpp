// SPDX-License-Identifier: MIT
// Numbers in attributes and elements, with a decimal point in any locale.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace muro::model_file {

/// Returns numbers separated by white space. On failure `error` completes a sentence that begins with the text: "`1,5`
/// is no number; ...".
std::vector<double> parse_numbers(std::string_view text, std::string& error);

/// Returns exactly `count` numbers, else nothing and `error`.
std::optional<std::vector<double>> parse_numbers(std::string_view text, std::size_t count, std::string& error);

/// Returns numbers separated by blanks, in the shortest form that every parser reads back to the same bits.
std::string text_of(const std::vector<double>& numbers);

}  // namespace muro::model_file
