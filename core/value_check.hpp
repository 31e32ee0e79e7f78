// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "muro/key.hpp"

namespace muro {

/// What is wrong with the values of a constant, as the end of a sentence: its poses, velocities, inertias, shapes and
/// numbers lie within muro/base/limits.hpp. Empty: nothing is. `count`: elements; a single value is one.
std::string problem_of_values(const KeyInfo& key, const void* data, std::uint32_t count);

/// Throws SetupError that names object and property when there is something.
void check_values(const std::string& object, const KeyInfo& key, const void* data, std::uint32_t count);

/// Throws SetupError unless `name` may be that of an object: UTF-8 without control characters, 1 to 255 bytes long, as
/// the name of a file. `what` begins the message.
void check_object_name(std::string_view name, const std::string& what);

}  // namespace muro
