// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <cstdint>

namespace muro {

/// A cheap clock for the costs of calls.
inline std::uint64_t ticks() {
#if defined(__x86_64__)
  return __builtin_ia32_rdtsc();
#elif defined(__aarch64__)
  std::uint64_t t;
  asm volatile("mrs %0, cntvct_el0" : "=r"(t));
  return t;
#else
  return std::uint64_t(std::chrono::steady_clock::now().time_since_epoch().count());
#endif
}

/// Relates ticks to seconds by what has passed since it was made.
class TickClock {
 public:
  TickClock() : first_tick_(ticks()), first_wall_(std::chrono::steady_clock::now()) {}
  double seconds_per_tick() const {
    const double wall = std::chrono::duration<double>(std::chrono::steady_clock::now() - first_wall_).count();
    const std::uint64_t passed = ticks() - first_tick_;
    return wall / double(passed > 0 ? passed : 1);
  }
  std::uint64_t first_tick() const { return first_tick_; }

 private:
  std::uint64_t first_tick_;
  std::chrono::steady_clock::time_point first_wall_;
};

}  // namespace muro
