// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <vector>

#include "host/scenario/node.hpp"

namespace muro::host {

/// Reads a file and resolves all `include:`s; `files` gets their paths. Throws SetupError with file:line:column.
Node load_yaml(const std::string& path, std::vector<std::string>* files = nullptr);

/// Reads a value from the command line; all of its nodes get the location `at`.
Node parse_yaml(const std::string& text, const Location& at);

}  // namespace muro::host
