// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string_view>

namespace muro {

/// The longest simulated time, ns: 146 years. Sums of two times still fit into 64 bits.
inline constexpr std::int64_t max_time = 4'600'000'000'000'000'000;

/// Converts `seconds` to ns, rounded. Throws SetupError that names `what` unless they are from 0 to 4.6e9 s.
std::int64_t nanoseconds_of(double seconds, std::string_view what);

/// Throws SetupError that names `what` unless `time` (ns) is from 0 to max_time.
void check_time(std::int64_t time, std::string_view what);

}  // namespace muro
