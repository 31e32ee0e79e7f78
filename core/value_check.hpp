// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>
#include <string_view>

#include "muro/key.hpp"

namespace muro {

/// Returns what is wrong with the values of a constant, as the end of a sentence: poses, velocities, inertias, shapes
/// and numbers must be within muro/base/limits.hpp. Empty: nothing is wrong. `count`: elements; 1: a single value.
std::string problem_of_values(const KeyInfo& key, const void* data, std::uint32_t count);

/// Throws SetupError with object and property when problem_of_values finds something.
void check_values(const std::string& object, const KeyInfo& key, const void* data, std::uint32_t count);

/// Throws SetupError unless `name` may name an object: UTF-8 without control characters, 1 to 255 bytes long, like the
/// name of a file. `what` begins the message.
void check_object_name(std::string_view name, const std::string& what);

}  // namespace muro
