// SPDX-License-Identifier: MIT
#pragma once

#include "heightmap_file.hpp"

namespace muro::heightmap {

/// Reads a file as load() does, but in this process. For services of the parser process, which a file may crash.
HeightmapFile read_values(const std::string& path);

}  // namespace muro::heightmap
