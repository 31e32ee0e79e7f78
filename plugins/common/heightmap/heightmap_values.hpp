// SPDX-License-Identifier: MIT
#pragma once

#include "heightmap_file.hpp"

namespace muro::heightmap {

/// As load(), in this process: for the services of the parser process, which may die of a file.
HeightmapFile read_values(const std::string& path);

}  // namespace muro::heightmap
