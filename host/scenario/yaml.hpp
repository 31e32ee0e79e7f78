// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "host/scenario/node.hpp"

namespace muro::host {

/// Reads a file with all its `include:`s. Throws SetupError with file:line:column.
Node load_yaml(const std::string& path);

/// Reads a value as written on the command line; all of it gets the location `at`.
Node parse_yaml(const std::string& text, const Location& at);

}  // namespace muro::host
