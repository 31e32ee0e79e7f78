// SPDX-License-Identifier: MIT
#pragma once

#include <atomic>
#include <chrono>
#include <cstdint>

namespace muro {

/// Decides how long a side polls for its turn before it sleeps. Polling pays when the other side runs on another
/// processor and finishes soon. When polling did not help, the side sleeps at once in the next waits and polls again
/// only sometimes. Otherwise two sides on one processor would block each other.
class Patience {
 public:
  /// `most`: longest time of polling; 0: never polls.
  explicit Patience(std::chrono::nanoseconds most) : most_(most), now_(most) {}

  /// Returns the time of polling for the next wait.
  std::chrono::nanoseconds spin() {
    if (now_.count() == 0 && ++waits_ % waits_between == 0) return most_;
    return now_;
  }
  /// Takes the result of that wait: whether the turn came before the side slept.
  void learn(bool was_worth_it) { now_ = was_worth_it ? most_ : std::chrono::nanoseconds(0); }

 private:
  static constexpr std::uint32_t waits_between = 256;
  std::chrono::nanoseconds most_, now_;
  std::uint32_t waits_ = 0;
};

/// A turn that two processes or threads pass to each other. It lies in memory that both share. The side that has the
/// turn may access the rest of that memory. The other side sees these writes when it gets the turn.
///
/// A side that waits polls for some time: when the other side runs meanwhile, this takes less than a microsecond. Then
/// it sleeps until it is woken (futex), which takes some microseconds.
class Turn {
 public:
  enum class Side : std::uint32_t { caller, callee };

  /// At the start the caller has the turn.
  Turn() = default;
  Turn(const Turn&) = delete;
  Turn& operator=(const Turn&) = delete;

  /// Ends the turn of the calling side.
  void pass_to(Side side) noexcept;
  /// Waits for the turn of `mine`: polls for some time, then sleeps for at most `sleep`. Returns false when it is not
  /// the turn of `mine` yet.
  bool wait_for(Side mine, Patience& patience, std::chrono::nanoseconds sleep) noexcept;

 private:
  bool look_for(Side mine, std::chrono::nanoseconds spin) const noexcept;
  bool is_of(Side side) const noexcept { return turn_.load() == std::uint32_t(side); }

  static_assert(std::atomic<std::uint32_t>::is_always_lock_free, "a futex is a word");

  alignas(64) std::atomic<std::uint32_t> turn_{0};
  std::atomic<std::uint32_t> is_asleep_[2]{};  ///< one for each side
};

}  // namespace muro
