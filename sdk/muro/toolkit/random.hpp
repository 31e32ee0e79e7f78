// SPDX-License-Identifier: MIT
// Counter-based random numbers: no state to keep, the same numbers in any order and on any thread.
#pragma once

#include <array>
#include <cmath>
#include <cstdint>
#include <string_view>

#include "muro/toolkit/elementary.hpp"

namespace muro {

/// FNV-1a, 64 bit: keys from names, and hashes of state.
constexpr std::uint64_t fnv1a(std::string_view text, std::uint64_t hash = 0xcbf29ce484222325ull) {
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 0x100000001b3ull;
  return hash;
}

/// Philox4x32-10 (Salmon, Moraes, Dror, Shaw: Parallel random numbers: as easy as 1, 2, 3; SC 2011).
constexpr std::array<std::uint32_t, 4> philox(std::array<std::uint32_t, 4> counter, std::array<std::uint32_t, 2> key) {
  for (int round = 0; round < 10; ++round) {
    const std::uint64_t a = 0xD2511F53ull * counter[0], b = 0xCD9E8D57ull * counter[2];
    counter = {std::uint32_t(b >> 32) ^ counter[1] ^ key[0], std::uint32_t(b),
               std::uint32_t(a >> 32) ^ counter[3] ^ key[1], std::uint32_t(a)};
    key[0] += 0x9E3779B9u;
    key[1] += 0xBB67AE85u;
  }
  return counter;
}

/// The numbers of one (seed, item, step). `item_key` comes from Connector::random_key.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t item_key, std::uint64_t step) : step_(step) {
    const std::uint64_t mixed =
        fnv1a({reinterpret_cast<const char*>(&seed), sizeof seed}, item_key ^ 0xcbf29ce484222325ull);
    key_ = {std::uint32_t(mixed), std::uint32_t(mixed >> 32)};
  }
  /// Uniform in [0, 1), 53 bits; `i` counts the draws of this step and may come in any order.
  double uniform(std::uint32_t i) const {
    const auto words = block(i, 0);
    return unit(words[0], words[1]);
  }
  /// Standard normal, by Box and Muller.
  double normal(std::uint32_t i) const { return normal_pair(i)[0]; }
  /// Two independent standard normal numbers at little more than the price of one; `normal(i)` is the first.
  std::array<double, 2> normal_pair(std::uint32_t i) const {
    const auto words = block(i, 1);
    const double u = 1 - unit(words[0], words[1]), angle = 6.283185307179586 * unit(words[2], words[3]);
    const double radius = std::sqrt(-2 * elementary::log(u));
    const auto [sine, cosine] = elementary::sincos(angle);
    return {radius * cosine, radius * sine};
  }

 private:
  std::array<std::uint32_t, 4> block(std::uint32_t i, std::uint32_t stream) const {
    return philox({i, stream, std::uint32_t(step_), std::uint32_t(step_ >> 32)}, key_);
  }
  static double unit(std::uint32_t high, std::uint32_t low) {
    return double(((std::uint64_t(high) << 32) | low) >> 11) * 0x1.0p-53;
  }
  std::uint64_t step_;
  std::array<std::uint32_t, 2> key_{};
};

}  // namespace muro
