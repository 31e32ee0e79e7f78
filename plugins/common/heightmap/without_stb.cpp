// SPDX-License-Identifier: MIT
#include "heightmap_values.hpp"
#include "muro/algorithm.hpp"

namespace muro::heightmap {

HeightmapFile read_values(const std::string& path) {
  throw Error("heightmap " + path + " cannot be read: muro was built without libstb-dev");
}

}  // namespace muro::heightmap
