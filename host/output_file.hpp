// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace muro::host {

/// Writes a file completely or not at all: see WholeFile. Throws SetupError.
void write_file(const std::string& path, const std::string& text);
/// Throws SetupError when the file cannot be written; does not change a file that exists.
void check_writable(const std::string& path);

}  // namespace muro::host
