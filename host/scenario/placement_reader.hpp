// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "host/scenario/map_reader.hpp"
#include "host/scenario/scenario.hpp"

namespace muro::host {

/// Reads `{count: [nx, ny], spacing: [dx, dy], center: {...}}`.
Placement read_grid(const Node& node, const std::string& what, Problems& problems);

/// Reads `at: {x, y, ...}`, or `place:` with one of `list`, `grid`, `random`; the origin when there is neither.
Placement read_placement(MapReader& map, Problems& problems);

}  // namespace muro::host
