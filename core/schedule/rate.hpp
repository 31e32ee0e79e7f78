// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>
#include <compare>
#include <cstdint>
#include <string>

#include "core/error.hpp"

namespace muro {

__extension__ using Wide = unsigned __int128;

/// A rate in whole microhertz, so that the times of its runs are exact integers.
class Rate {
 public:
  Rate() = default;
  /// From Hz, rounded to 1e-6 Hz; 0 means on demand. Throws SetupError unless 0 or from 1e-6 to 1e9.
  explicit Rate(double hertz) {
    if (hertz != 0 && !(hertz >= 1e-6 && hertz <= 1e9)) refuse(hertz);
    microhertz_ = std::llround(hertz * 1e6);
  }

  bool on_demand() const { return microhertz_ == 0; }
  double hertz() const { return 1e-6 * double(microhertz_); }
  double period() const { return 1e6 / double(microhertz_); }  ///< s
  /// When the k-th run is due: floor(k * 1e9 / R) ns.
  std::int64_t time_of(std::uint64_t k) const {
    return std::int64_t(static_cast<Wide>(k) * 1'000'000'000'000'000ull / std::uint64_t(microhertz_));
  }
  /// The first run that is due at `time` (ns) or later.
  std::uint64_t first_from(std::int64_t time) const {
    if (time <= 0) return 0;
    auto k = std::uint64_t(static_cast<Wide>(time) * std::uint64_t(microhertz_) / 1'000'000'000'000'000ull);
    while (time_of(k) < time) ++k;
    return k;
  }
  auto operator<=>(const Rate&) const = default;

 private:
  [[noreturn]] static void refuse(double hertz);  // in scheduler.cpp, which has fmt

  std::int64_t microhertz_ = 0;
};

}  // namespace muro
