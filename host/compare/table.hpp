// SPDX-License-Identifier: MIT
// What a comparison prints: deviation against cost, level by level.
#pragma once

#include <string>
#include <vector>

#include "host/compare/level.hpp"

namespace muro::host {

struct Compared {
  const Comparison& comparison;
  const std::vector<Level>& levels;
  std::size_t reference;  ///< among the levels
};

/// For the terminal.
std::string table(const Compared& compared);
/// For programs, a line each level.
std::string csv(const Compared& compared);
/// A drawing (SVG) of the levels that ran: cost across, deviation upwards.
std::string picture(const Compared& compared);

/// How many of the robots that are compared run in real time on one core, if all cost the same.
double real_time_robots(const Comparison& comparison, const Level& level);
/// Of a level that ran from the reference; none if that did not run.
std::optional<Deviation> deviation_of(const Level& level, const Level& reference);

}  // namespace muro::host
