// SPDX-License-Identifier: MIT
// Pictures of what is no colour.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "muro/object.hpp"

namespace muro::host {

/// sRGB: the nearest depth (m) is dark blue, the farthest bright yellow, evenly by its logarithm; what has none is
/// black.
std::vector<std::uint8_t> colors_of(std::span<const float> depth);
/// sRGB: a colour for each object, the same in every picture; black where there is none.
std::vector<std::uint8_t> colors_of(std::span<const ObjectId> labels);

}  // namespace muro::host
