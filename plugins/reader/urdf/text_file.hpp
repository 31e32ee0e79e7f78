// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "problems.hpp"

namespace muro::urdf {

/// The bytes of a file. Throws muro::Error when there is no such file, or it has more than 64 MiB.
std::string load_file(const std::string& path);

/// `bytes` as UTF-8 without a byte-order mark. Text that is not UTF-8 is read as ISO-8859-1, with a
/// warning; UTF-16, binary and empty files are errors.
std::string decoded(std::string bytes, Problems& problems);

}  // namespace muro::urdf
