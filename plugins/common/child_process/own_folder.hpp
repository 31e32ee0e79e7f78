// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace muro {

/// Returns the folder of the shared library, or the program, that calls this: each has its own copy of this function.
/// Returns an empty text if the folder is unknown.
std::string own_folder();

}  // namespace muro
