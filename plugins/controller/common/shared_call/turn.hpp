// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

namespace muro {

/// For how long a side looks for its turn before it sleeps. To look pays where the other side runs on another processor
/// and is soon done. Where it did not, the side sleeps at once, and tries again now and then: else, where both share a
/// processor, each would keep the other one from it.
class Patience {
 public:
  /// 0: never.
  explicit Patience(std::chrono::nanoseconds most) : most_(most), now_(most) {}

  /// For the next wait.
  std::chrono::nanoseconds spin() {
    if (now_.count() == 0 && ++waits_ % waits_between == 0) return most_;
    return now_;
  }
  /// How that wait ended: whether it was one's turn before one slept.
  void learn(bool was_worth_it) { now_ = was_worth_it ? most_ : std::chrono::nanoseconds(0); }

 private:
  static constexpr std::uint32_t waits_between = 256;
  std::chrono::nanoseconds most_, now_;
  std::uint32_t waits_ = 0;
};

/// Two processes, or threads, that take turns: it lies in memory that both have. Who has the turn may touch the rest of
/// that memory; what it has written there is seen by the other one when it has the turn.
///
/// A side that waits looks again and again for a while, which takes less than a microsecond where the other side runs
/// meanwhile, and then sleeps until it is woken (futex), which takes some microseconds.
class Turn {
 public:
  enum class Side : std::uint32_t { caller, callee };

  /// It is the caller's turn at the start.
  Turn() = default;
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

  /// Ends one's own turn.
  void pass_to(Side side) noexcept;
  /// Waits until it is the turn of `mine`: looks for some time, then sleeps for `sleep` at most. False when it is not
  /// yet.
  bool wait_for(Side mine, Patience& patience, std::chrono::nanoseconds sleep) noexcept;

 private:
  bool look_for(Side mine, std::chrono::nanoseconds spin) const noexcept;
  bool is_of(Side side) const noexcept { return turn_.load() == std::uint32_t(side); }

  static_assert(std::atomic<std::uint32_t>::is_always_lock_free, "a futex is a word");

  alignas(64) std::atomic<std::uint32_t> turn_{0};
  std::atomic<std::uint32_t> is_asleep_[2]{};  ///< by side
};

}  // namespace muro
