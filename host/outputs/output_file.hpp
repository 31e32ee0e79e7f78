// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace muro::host {

/// Writes a file completely or not at all: see WholeFile. Throws StepError: names were checked before the run.
void write_file(const std::string& path, const std::string& text);

}  // namespace muro::host
