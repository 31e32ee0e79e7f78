// SPDX-License-Identifier: MIT
#include "turn.hpp"

#include <linux/futex.h>
#include <sys/syscall.h>
#include <unistd.h>

#include <ctime>

namespace muro {

namespace {

using Clock = std::chrono::steady_clock;

/// Pauses for a moment, so that the other hardware thread of the core can run.
void relax() {
#if defined(__x86_64__)
  __builtin_ia32_pause();
#elif defined(__aarch64__)
  asm volatile("yield");
#endif
}

std::uint32_t* word(std::atomic<std::uint32_t>& value) { return reinterpret_cast<std::uint32_t*>(&value); }

}  // namespace

void Turn::pass_to(Side side) noexcept {
  turn_.store(std::uint32_t(side));
  if (is_asleep_[std::uint32_t(side)].exchange(0) != 0)
    syscall(SYS_futex, word(turn_), FUTEX_WAKE, 1, nullptr, nullptr, 0);
}

bool Turn::look_for(Side mine, std::chrono::nanoseconds spin) const noexcept {
  constexpr int looks_between = 32;  // reading the clock takes as long as some of these checks
  if (is_of(mine)) return true;
  for (const Clock::time_point end = Clock::now() + spin; spin.count() > 0 && Clock::now() < end;)
    for (int i = 0; i < looks_between; ++i) {
      if (is_of(mine)) return true;
      relax();
    }
  return false;
}

bool Turn::wait_for(Side mine, Patience& patience, std::chrono::nanoseconds sleep) noexcept {
  const std::chrono::nanoseconds spin = patience.spin();
  const bool came = look_for(mine, spin);
  if (spin.count() > 0) patience.learn(came);
  if (came) return true;
  is_asleep_[std::uint32_t(mine)].store(1);
  if (is_of(mine)) return true;  // the other side may wake nobody then, which does no harm
  const timespec most{time_t(sleep.count() / 1'000'000'000), long(sleep.count() % 1'000'000'000)};
  syscall(SYS_futex, word(turn_), FUTEX_WAIT, std::uint32_t(mine) ^ 1u, &most, nullptr, 0);
  return is_of(mine);
}

}  // namespace muro
