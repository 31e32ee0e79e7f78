// SPDX-License-Identifier: MIT
// For the parser process: bounds of memory and time for one request.
#pragma once

#include "protocol.hpp"

namespace muro::parser_process {

/// From here to end_limits, the process may take `base`, or what the user has set instead, and what allow() adds,
/// beside what it has now; where it takes more it ends. Not with a sanitizer: no
/// bound of memory, and ten times as long.
void begin_limits(const Allowance& base);
void end_limits();

/// For those who read: adds what a file just opened may need. Does nothing outside of begin_limits and end_limits.
__attribute__((visibility("default"))) void allow(const Allowance& more);

/// MiB, and seconds for one MiB.
constexpr Allowance allowance_for(std::uint64_t bytes, std::uint64_t factor, double seconds) {
  return {bytes * factor, double(bytes) / (1 << 20) * seconds};
}

}  // namespace muro::parser_process
