// SPDX-License-Identifier: MIT
// Output of `spot` for other control code of its robot: the places of targets in the last picture.
#pragma once

#include <cstddef>
#include <span>

#include "../common/place.hpp"
#include "muro_controller.hpp"

namespace mixed_team {

using examples::Point;

constexpr std::size_t most_spots = 8, numbers_of_spot = 3, numbers_of_spots = 1 + numbers_of_spot * most_spots;
/// Number of pictures so far; then for each spot in the last one: m forward and left of the base, level, and its number
/// of pixels. 0 pixels: no more spots.
constexpr muro_port spots_port = {"spot.seen", "1, m, m, px", numbers_of_spots, MURO_PORT_OPTIONAL};

/// Calls `take` with the place of each spot.
template <class Take>
void for_spots(std::span<const double> seen, Take take) {
  for (std::size_t i = 1; i + numbers_of_spot <= seen.size() && seen[i + 2] > 0; i += numbers_of_spot)
    take(Point{seen[i], seen[i + 1]});
}

}  // namespace mixed_team
