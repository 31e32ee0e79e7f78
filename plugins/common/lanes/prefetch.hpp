// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace muro::lane {

/// Prefetches the cache lines of `bytes` bytes from `from` on. Lines that are requested together arrive together.
inline void prefetch_lines(const void* from, std::size_t bytes) {
  constexpr std::size_t line = 64;
  if (bytes == 0) return;
  const char* const begin = static_cast<const char*>(from);
  for (std::size_t i = 0; i < bytes; i += line) __builtin_prefetch(begin + i);
  __builtin_prefetch(begin + bytes - 1);  // it may be on the next line
  asm volatile("");  // gcc omits calls of functions that only prefetch, because they have no effect
}

}  // namespace muro::lane
