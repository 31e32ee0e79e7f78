// SPDX-License-Identifier: MIT
#include "core/simulated_time.hpp"

#include <fmt/format.h>

#include <cmath>

#include "core/error.hpp"

namespace muro {

std::int64_t nanoseconds_of(double seconds, std::string_view what) {
  constexpr double most = 1e-9 * double(max_time);
  if (seconds >= 0 && seconds <= most) return std::llround(seconds * 1e9);
  throw SetupError(fmt::format("{} is {} s but must be from 0 to 4.6e9 s", what, seconds));
}

void check_time(std::int64_t time, std::string_view what) {
  if (time < 0 || time > max_time)
    throw SetupError(fmt::format("{} is {} ns but must be from 0 to 4.6e18 ns", what, time));
}

}  // namespace muro
