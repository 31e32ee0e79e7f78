// SPDX-License-Identifier: MIT
#include "sweep.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace muro::scanner {

Sweep::Sweep(const Grid& grid, bool is_list, std::uint32_t steps) : first_(steps + 1, grid.columns) {
  std::uint32_t next = 0;  // first step without a known first column
  for (std::uint32_t column = 0; column < grid.columns; ++column) {
    const double revolutions =
        is_list ? double(column) / grid.columns : (grid.azimuth(column) - grid.first_angle()) / (2 * std::numbers::pi);
    const double at = revolutions * steps;
    const auto step = std::uint32_t(std::clamp(at, 0.0, double(steps - 1)));
    while (next <= step) first_[next++] = column;
    time_fractions_.push_back(std::clamp(at - step, 0.0, 1.0));
    last_step_ = step;
  }
}

}  // namespace muro::scanner
