// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace muro {

/// The name in the folder of `path` that is nearest to its own, as in did_you_mean(), or "".
std::string nearest_file(const std::string& path);

/// Of a file that is not there: " does not exist in FOLDER (did you mean `NAME`?)".
std::string why_missing(const std::string& path);

}  // namespace muro
