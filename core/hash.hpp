// SPDX-License-Identifier: MIT
#pragma once

#include <bit>
#include <cstdint>
#include <cstring>

namespace muro {

/// Returns a 64-bit hash of bytes, eight at a time (multiply and rotate, finished with the mixer of SplitMix64).
inline std::uint64_t hash_bytes(const void* data, std::size_t size, std::uint64_t seed) {
  std::uint64_t h = seed ^ (size * 0x9E3779B97F4A7C15ull);
  const auto* p = static_cast<const unsigned char*>(data);
  while (size > 0) {
    std::uint64_t word = 0;
    const std::size_t n = size < 8 ? size : 8;
    std::memcpy(&word, p, n);
    h = std::rotl((h ^ word) * 0xBF58476D1CE4E5B9ull, 29);
    p += n;
    size -= n;
  }
  h = (h ^ (h >> 30)) * 0xBF58476D1CE4E5B9ull;
  h = (h ^ (h >> 27)) * 0x94D049BB133111EBull;
  return h ^ (h >> 31);
}

}  // namespace muro
