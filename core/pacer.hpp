// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>

namespace muro {

/// How fast simulated time may pass.
struct Pacing {
  double factor = 0;  ///< simulated seconds per second of wall clock; 0: as fast as possible
};

/// How late instants began, by the wall clock, in a run with a chosen speed.
struct Lateness {
  /// Bin 0: below 1 us; bin i: from 2^(i-1) up to 2^i us; the last one: all above.
  static constexpr std::size_t bins = 24;
  std::array<std::uint64_t, bins> histogram{};
  std::uint64_t instants = 0;
  std::uint64_t overruns = 0;  ///< late by more than the shortest period
  double total = 0;            ///< s
  double longest = 0;          ///< s

  void add(double seconds);
  double mean() const { return instants > 0 ? total / double(instants) : 0; }
  /// Upper end, in s, of the bin below which `fraction` of all instants lie; 0 without instants.
  double quantile(double fraction) const;
  /// Upper end of a bin in s.
  static double upper_end(std::size_t bin);
};

/// Keeps simulated time from passing faster than chosen.
class Pacer {
 public:
  /// Counts from here: simulated time `now` (ns) is the present moment.
  void begin(Pacing pacing, std::int64_t now);
  Pacing pacing() const { return pacing_; }
  bool is_active() const { return pacing_.factor > 0; }
  /// Waits until `now` (ns) is due; true when `stop` wants to end the wait. `period`: ns, the shortest one. Time that
  /// was lost is not made up for by running faster than asked.
  bool wait(std::int64_t now, std::int64_t period, const std::function<bool()>& stop);
  const Lateness& lateness() const { return lateness_; }

 private:
  using Clock = std::chrono::steady_clock;
  Pacing pacing_;
  Clock::time_point wall_{};
  std::int64_t from_ = 0;
  Lateness lateness_;
};

}  // namespace muro
