// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace muro {

/// Returns the name in the folder of `path` that is nearest to its file name, as in did_you_mean(), or "".
std::string nearest_file(const std::string& path);

/// Returns the end of a message about a missing file: " does not exist in FOLDER (did you mean `NAME`?)".
std::string why_missing(const std::string& path);

}  // namespace muro
