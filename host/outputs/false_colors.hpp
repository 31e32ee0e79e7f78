// SPDX-License-Identifier: MIT
// Pictures of depths and labels in false colours.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "muro/object.hpp"

namespace muro::host {

/// Returns sRGB: the nearest depth (m) is dark blue, the farthest is bright yellow, in between by its logarithm;
/// infinite depth is black.
std::vector<std::uint8_t> colors_of(std::span<const float> depth);
/// Returns sRGB: one colour for each object, the same in every picture; black where there is no object.
std::vector<std::uint8_t> colors_of(std::span<const ObjectId> labels);

}  // namespace muro::host
