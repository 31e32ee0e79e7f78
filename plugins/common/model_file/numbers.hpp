// SPDX-License-Identifier: MIT
// Numbers in attributes and elements, in any locale written with a decimal point.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace muro::model_file {

/// Numbers separated by white space. On failure `error` completes a sentence that begins with the text: "`1,5` is no
/// number; ...".
std::vector<double> parse_numbers(std::string_view text, std::string& error);

/// Exactly `count` numbers, else nothing and `error`.
std::optional<std::vector<double>> parse_numbers(std::string_view text, std::size_t count, std::string& error);

/// Numbers separated by blanks, in the shortest form that every parser reads back to the same bits.
std::string text_of(const std::vector<double>& numbers);

}  // namespace muro::model_file
