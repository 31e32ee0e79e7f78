// SPDX-License-Identifier: MIT
// The results of a comparison as text: deviation against cost for each variation.
#pragma once

#include <string>
#include <vector>

#include "host/tools/compare/comparison.hpp"

namespace muro::host {

struct Compared {
  const Comparison& comparison;
  const std::vector<VariationResult>& results;
  std::size_t reference;  ///< index of the result with which the others are compared
};

/// Returns the table for the terminal.
std::string table(const Compared& compared);
/// Returns the table for programs, a line for each variation.
std::string csv(const Compared& compared);
/// Returns a drawing (SVG) of the variations that ran: cost to the right, deviation upwards.
std::string picture(const Compared& compared);

/// Number of robots like the compared ones that run in real time on one core.
double real_time_robots(const Comparison& comparison, const VariationResult& result);
/// Returns the deviation from the reference; nothing when one of both did not run.
std::optional<Deviation> deviation_of(const VariationResult& result, const VariationResult& reference);

}  // namespace muro::host
