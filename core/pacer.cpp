// SPDX-License-Identifier: MIT
#include "core/pacer.hpp"

#include <algorithm>
#include <cmath>
#include <thread>

namespace muro {

namespace {

std::chrono::nanoseconds nanoseconds(double ns) {
  constexpr double longest = 1e18;  // a wait without an end
  return std::chrono::nanoseconds(std::int64_t(std::min(longest, ns)));
}

}  // namespace

double Lateness::upper_end(std::size_t bin) { return std::ldexp(1e-6, int(bin)); }

void Lateness::add(double seconds) {
  std::size_t bin = 0;
  while (bin + 1 < bins && seconds >= upper_end(bin)) ++bin;
  ++histogram[bin];
  ++instants;
  total += seconds;
  longest = std::max(longest, seconds);
}

double Lateness::quantile(double fraction) const {
  if (instants == 0) return 0;
  std::uint64_t below = 0;
  for (std::size_t bin = 0; bin + 1 < bins; ++bin)
    if (below += histogram[bin]; double(below) >= fraction * double(instants)) return std::min(upper_end(bin), longest);
  return longest;
}

void Pacer::begin(Pacing pacing, std::int64_t now) {
  pacing_ = pacing;
  wall_ = Clock::now();
  from_ = now;
}

bool Pacer::wait(std::int64_t now, std::int64_t period, const std::function<bool()>& stop) {
  const auto due = wall_ + nanoseconds(double(now - from_) / pacing_.factor);
  auto wall = Clock::now();
  if (wall < due) {
    constexpr auto slice = std::chrono::milliseconds(50);  // between looks at `stop`
    for (; wall < due; wall = Clock::now()) {
      if (stop && stop()) return true;
      std::this_thread::sleep_until(std::min(due, wall + slice));
    }
  } else if (wall - due > nanoseconds(double(period) / pacing_.factor)) {
    ++lateness_.overruns;
    wall_ += wall - due;
  }
  lateness_.add(std::chrono::duration<double>(wall - due).count());
  return false;
}

}  // namespace muro
