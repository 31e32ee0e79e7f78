// SPDX-License-Identifier: MIT
// Counter-based random numbers: they need no state, and are the same in any order and on any thread.
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "muro/base/elementary.hpp"

namespace muro {

/// FNV-1a, 64 bit: for keys from names, and for hashes of state.
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

/// Random numbers of one (seed, item, step). `item_key` comes from Connector::random_key.
class Random {
 public:
  Random(std::uint64_t seed, std::uint64_t item_key, std::uint64_t step) : step_(step) {
    const std::uint64_t mixed =
        fnv1a({reinterpret_cast<const char*>(&seed), sizeof seed}, item_key ^ 0xcbf29ce484222325ull);
    key_ = {std::uint32_t(mixed), std::uint32_t(mixed >> 32)};
  }
  /// Uniform in [0, 1), 53 bits. `i` is the index of the draw in this step; draws may be in any order.
  double uniform(std::uint32_t i) const {
    const auto words = block(i, 0);
    return unit(words[0], words[1]);
  }
  /// Standard normal, with the method of Box and Muller.
  double normal(std::uint32_t i) const { return normal_pair(i)[0]; }
  /// Two independent standard normal numbers for little more than the cost of one; `normal(i)` is the first.
  std::array<double, 2> normal_pair(std::uint32_t i) const {
    const auto words = block(i, 1);
    const double u = 1 - unit(words[0], words[1]), angle = 6.283185307179586 * unit(words[2], words[3]);
    const double radius = std::sqrt(-2 * elementary::log(u));
    const auto [sine, cosine] = elementary::sincos(angle);
    return {radius * cosine, radius * sine};
  }
  /// normal_pair of `i`, `i` + 1, ...: the same bits, two at once when the processor has packs of two.
  void normal_pairs(std::uint32_t i, std::span<std::array<double, 2>> pairs) const {
    std::size_t k = 0;
#if defined(__SSE2__)
    for (; k + 1 < pairs.size(); k += 2) {
      const auto a = block(std::uint32_t(i + k), 1), b = block(std::uint32_t(i + k + 1), 1);
      const Two u{1 - unit(a[0], a[1]), 1 - unit(b[0], b[1])}, v{unit(a[2], a[3]), unit(b[2], b[3])};
      const Two log = log_of_two(u);
      const TwoSinCos turn = sincos_of_two(6.283185307179586 * v);
      for (int lane = 0; lane < 2; ++lane) {
        const double radius = std::sqrt(-2 * log[lane]);
        pairs[k + std::size_t(lane)] = {radius * turn.cos[lane], radius * turn.sin[lane]};
      }
    }
#endif
    for (; k < pairs.size(); ++k) pairs[k] = normal_pair(std::uint32_t(i + k));
  }

 private:
#if defined(__SSE2__)
  typedef double Two __attribute__((vector_size(16)));
  struct TwoSinCos {
    Two sin, cos;
  };
  static Two log_of_two(Two) __asm__("Sleef_cinz_logd2_u10sse2");
  static TwoSinCos sincos_of_two(Two) __asm__("Sleef_cinz_sincosd2_u10sse2");
#endif
  std::array<std::uint32_t, 4> block(std::uint32_t i, std::uint32_t stream) const {
    return philox({i, stream, std::uint32_t(step_), std::uint32_t(step_ >> 32)}, key_);
  }
  static double unit(std::uint32_t high, std::uint32_t low) {
    return double(((std::uint64_t(high) << 32) | low) >> 11) * 0x1.0p-53;
  }
  std::uint64_t step_;
  std::array<std::uint32_t, 2> key_{};
};

/// Exactly `count` normal numbers, one after the other: those of normal_pair(first), normal_pair(first + 1), ...
class NormalNumbers {
 public:
  NormalNumbers(const Random& random, std::size_t count, std::uint32_t first = 0)
      : random_(random), count_(count), first_(first) {}
  double next() {
    const std::size_t at = index_++ % (2 * pairs_.size());
    if (at == 0) refill();
    return pairs_[at / 2][at % 2];
  }

 private:
  void refill() {
    const std::size_t left = (count_ - index_ + 2) / 2;
    random_.normal_pairs(std::uint32_t(first_ + index_ / 2), std::span(pairs_).first(std::min(left, pairs_.size())));
  }
  const Random& random_;
  std::size_t count_, index_ = 0;
  std::uint32_t first_;
  std::array<std::array<double, 2>, 16> pairs_{};
};

}  // namespace muro
