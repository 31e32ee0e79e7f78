// SPDX-License-Identifier: MIT
// What `spot` tells other control code of its robot: where in the last picture targets are seen.
#pragma once

#include <cstddef>
#include <span>

#include "muro_controller.hpp"
#include "plane.hpp"

namespace mixed_team {

constexpr std::size_t most_spots = 8;
/// Of each: m forward and left of the base, level, and how many pixels it has; 0 pixels: no more.
constexpr muro_port spots_port = {"spot.seen", "m, m, px", 3 * most_spots, MURO_PORT_OPTIONAL};
/// How many pictures it has looked at.
constexpr muro_port pictures_port = {"spot.pictures", "1", 1, MURO_PORT_OPTIONAL};

/// Calls `take` with the place of each.
template <class Take>
void for_spots(std::span<const double> seen, Take take) {
  for (std::size_t i = 0; i + 3 <= seen.size() && seen[i + 2] > 0; i += 3) take(Point{seen[i], seen[i + 1]});
}

}  // namespace mixed_team
