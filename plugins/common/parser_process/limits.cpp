// SPDX-License-Identifier: MIT
#include "limits.hpp"

#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>

namespace muro::parser_process {

namespace {

#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
constexpr bool with_sanitizer = true;
#elif defined(__has_feature)
#if __has_feature(address_sanitizer) || __has_feature(thread_sanitizer) || __has_feature(memory_sanitizer)
constexpr bool with_sanitizer = true;
#else
constexpr bool with_sanitizer = false;
#endif
#else
constexpr bool with_sanitizer = false;
#endif

/// Of real time to processor time: a busy machine, a slow disk.
constexpr double patience = 20;

struct State {
  bool active = false;
  std::uint64_t used = 0;  ///< bytes, at the beginning
  Allowance sum;
};
State state;

/// Bytes of address space.
std::uint64_t address_space() {
  unsigned long long pages = 0;
  if (std::FILE* const file = std::fopen("/proc/self/statm", "r")) {
    if (std::fscanf(file, "%llu", &pages) != 1) pages = 0;
    std::fclose(file);
  }
  return pages * std::uint64_t(sysconf(_SC_PAGESIZE));
}

/// What a user has set, or else `value`.
double setting(const char* variable, double value) {
  const char* const text = std::getenv(variable);
  const double set = text ? std::strtod(text, nullptr) : 0;
  return set > 0 && set <= 1e9 ? set : value;
}

void set_memory(rlim_t bytes) {
  rlimit limit{};
  getrlimit(RLIMIT_AS, &limit);
  limit.rlim_cur = std::min(bytes, limit.rlim_max);
  setrlimit(RLIMIT_AS, &limit);
}

void set_timer(int which, double seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = time_t(seconds);
  timer.it_value.tv_usec = suseconds_t((seconds - std::floor(seconds)) * 1e6);
  setitimer(which, &timer, nullptr);
}

void apply() {
  if (!with_sanitizer) set_memory(state.used + state.sum.memory);
  const double seconds = with_sanitizer ? 10 * state.sum.seconds : state.sum.seconds;
  set_timer(ITIMER_PROF, seconds);
  set_timer(ITIMER_REAL, patience * seconds);
  // for the client, should this process die
  if (pwrite(process_allowance, &state.sum, sizeof state.sum, 0) < 0) return;
}

}  // namespace

void begin_limits(const Allowance& base) {
  state = {true, address_space(), base};
  state.sum.memory = std::uint64_t(setting(memory_variable, double(base.memory) / (1 << 20)) * (1 << 20));
  state.sum.seconds = setting(seconds_variable, base.seconds);
  apply();
}

void end_limits() {
  if (!state.active) return;
  state.active = false;
  set_timer(ITIMER_PROF, 0);
  set_timer(ITIMER_REAL, 0);
  if (!with_sanitizer) set_memory(RLIM_INFINITY);
}

void allow(const Allowance& more) {
  if (!state.active) return;
  state.sum.memory += more.memory;
  state.sum.seconds += more.seconds;
  apply();
}

}  // namespace muro::parser_process
