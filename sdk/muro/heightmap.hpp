// SPDX-License-Identifier: MIT
#pragma once

#include "muro/key.hpp"

namespace muro::keys {

/// Array, constant of the body of a model that was read from the file of a heightmap: its values, row by row from -y,
/// in each from -x (see toolkit/heightmap.hpp). Hosts ask for it to place what stands on it.
inline constexpr Key<float> heightmap_values{"heightmap.values", "1", "values of a heightmap at its nodes"};
/// Constant of the same body.
inline constexpr Key<std::uint32_t> heightmap_columns{"heightmap.columns", "1", "nodes of a heightmap along x"};

}  // namespace muro::keys
