// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

namespace muro::lane {

/// Prefetches the cache lines of `bytes` from `from` on: lines that are asked for together come together.
inline void prefetch_lines(const void* from, std::size_t bytes) {
  constexpr std::size_t line = 64;
  if (bytes == 0) return;
  const char* const begin = static_cast<const char*>(from);
  for (std::size_t i = 0; i < bytes; i += line) __builtin_prefetch(begin + i);
  __builtin_prefetch(begin + bytes - 1);  // which may be on a line further
  asm volatile("");  // gcc leaves out calls of functions that do nothing but prefetch: they have no effect
}

}  // namespace muro::lane
