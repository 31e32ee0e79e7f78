// SPDX-License-Identifier: MIT
// Bounds of memory and time for one request, in the parser process.
#pragma once

#include "protocol.hpp"

namespace muro::parser_process {

/// Limits the process until end_limits. Beside what it has now it may take `base`, or what the user has set instead,
/// and what allow() adds. If it takes more, it ends. With a sanitizer there is no bound of memory, and the time is ten
/// times as long.
void begin_limits(const Allowance& base);
void end_limits();

/// Adds what a file just opened may need. Readers call it. Does nothing outside of begin_limits and end_limits.
__attribute__((visibility("default"))) void allow(const Allowance& more);

/// Returns `factor` times `bytes` of memory, and `seconds` for each MiB of them.
constexpr Allowance allowance_for(std::uint64_t bytes, std::uint64_t factor, double seconds) {
  return {bytes * factor, double(bytes) / (1 << 20) * seconds};
}

}  // namespace muro::parser_process
