// SPDX-License-Identifier: MIT
// Values of variables as scenarios and files write them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model_description.hpp"

namespace muro::fmu {

/// Reads the numbers of a variable that is no text and no binary data: several separated by blanks for an array, true
/// or false, the name of an item of an enumeration where that is no number of its type. `bytes` gets them as functions
/// of FMI `version` take them. Returns what is wrong as the end of a sentence that begins with the text, "" where
/// nothing is.
std::string read_numbers(const Variable& variable, std::string_view text, int version, std::vector<std::byte>& bytes);

/// Binary data, two hexadecimal digits a byte; nothing where the text is something else.
std::optional<std::vector<std::uint8_t>> bytes_of_hexadecimal(std::string_view text);
/// What is wrong then, as the end of a sentence.
inline constexpr std::string_view is_no_hexadecimal = "is not made of two hexadecimal digits a byte, such as 00ff";

}  // namespace muro::fmu
