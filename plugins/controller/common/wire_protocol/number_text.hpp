// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace muro::wire {

/// Adds the shortest decimal that reads back as this number.
void add_number(std::string& out, double number);
/// Adds a time in seconds, as an exact decimal: 1250000000 as 1.25.
void add_seconds(std::string& out, std::int64_t nanoseconds);
/// Adds a unit in one word: "kg m^2" as kg*m^2.
void add_unit(std::string& out, std::string_view unit);

/// Reads a finite number; a sign is allowed. Throws Fault.
double read_number(std::string_view text);

/// Splits a line into the fields between blanks and tabs.
void split_fields(std::string_view line, std::vector<std::string_view>& out);

}  // namespace muro::wire
