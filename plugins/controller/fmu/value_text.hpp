// SPDX-License-Identifier: MIT
// Texts of values of variables in scenarios and files.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model_description.hpp"

namespace muro::fmu {

/// Reads the numbers of a variable that is no text and no binary data. An array has several, separated by blanks.
/// Allowed words are true, false and names of enumeration items, unless the word is a number of the type. `bytes` gets
/// the numbers in the form of FMI `version`. Returns "" or the problem, as the end of a sentence that begins with the
/// text.
std::string read_numbers(const Variable& variable, std::string_view text, int version, std::vector<std::byte>& bytes);

/// Reads binary data, two hexadecimal digits for each byte; returns nothing for any other text.
std::optional<std::vector<std::uint8_t>> bytes_of_hexadecimal(std::string_view text);
/// The problem in that case, as the end of a sentence.
inline constexpr std::string_view is_no_hexadecimal = "is not made of two hexadecimal digits a byte, such as 00ff";

}  // namespace muro::fmu
