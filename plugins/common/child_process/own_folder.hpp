// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace muro {

/// The folder of the shared library, or the program, that calls this: each has a copy of this function. Empty when it
/// is unknown.
std::string own_folder();

}  // namespace muro
