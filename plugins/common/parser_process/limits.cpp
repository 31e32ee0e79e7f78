// SPDX-License-Identifier: MIT
#include "limits.hpp"

#include <sys/resource.h>
#include <sys/time.h>
#include <unistd.h>

#include <cmath>
#include <cstdlib>

#include "plugins/common/child_process/address_space.hpp"

namespace muro::parser_process {

namespace {

/// Ratio of real time to processor time, for a busy machine or a slow disk.
constexpr double patience = 20;

struct State {
  bool active = false;
  std::uint64_t used = 0;  ///< bytes at the beginning of the request
  Allowance sum;
};
State state;

/// Returns what a user has set, or else `value`.
double setting(const char* variable, double value) {
  const char* const text = std::getenv(variable);
  const double set = text ? std::strtod(text, nullptr) : 0;
  return set > 0 && set <= 1e9 ? set : value;
}

void set_timer(int which, double seconds) {
  itimerval timer{};
  timer.it_value.tv_sec = time_t(seconds);
  timer.it_value.tv_usec = suseconds_t((seconds - std::floor(seconds)) * 1e6);
  setitimer(which, &timer, nullptr);
}

void apply() {
  bound_address_space(state.used + state.sum.memory);
  const double seconds = is_sanitized ? 10 * state.sum.seconds : state.sum.seconds;
  set_timer(ITIMER_PROF, seconds);
  set_timer(ITIMER_REAL, patience * seconds);
  // for the client, if this process dies
  if (pwrite(process_allowance, &state.sum, sizeof state.sum, 0) < 0) return;
}

}  // namespace

void begin_limits(const Allowance& base) {
  state = {true, own_address_space(), base};
  state.sum.memory = std::uint64_t(setting(memory_variable, double(base.memory) / (1 << 20)) * (1 << 20));
  state.sum.seconds = setting(seconds_variable, base.seconds);
  apply();
}

void end_limits() {
  if (!state.active) return;
  state.active = false;
  set_timer(ITIMER_PROF, 0);
  set_timer(ITIMER_REAL, 0);
  bound_address_space(RLIM_INFINITY);
}

void allow(const Allowance& more) {
  if (!state.active) return;
  state.sum.memory += more.memory;
  state.sum.seconds += more.seconds;
  apply();
}

}  // namespace muro::parser_process
