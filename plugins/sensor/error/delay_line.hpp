// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <span>

#include "per_component.hpp"

namespace muro {

/// A delay. Returns the bits of the newest sample that is at least as old as the delay, as a device reports whole
/// readings. Until the line is full it returns the first sample.
class DelayLine {
 public:
  DelayLine() = default;
  /// `delay` and `period` in s.
  DelayLine(double delay, std::size_t components, double period, StateLayout& layout) : components_(components) {
    if (!(delay > 0)) return;
    const double samples = delay / period, nearest = std::round(samples);
    const bool is_multiple = std::abs(samples - nearest) <= 1e-9 * std::max(1.0, samples);
    whole_ = std::size_t(is_multiple ? nearest : std::ceil(samples));
    if (!is_active()) return;
    slots_ = whole_ + 1;
    state_ = layout.reserve(1 + slots_ * components);
  }

  bool is_active() const { return whole_ > 0; }
  /// Returns the number of samples that the line holds.
  static double samples(double delay, double period) { return delay / period + 2; }

  void apply(std::span<double> values, std::span<double> state, bool first) const {
    double* const newest = &state[state_];
    double* const line = newest + 1;
    const auto slot = [&](std::size_t age) {
      return line + (std::size_t(*newest) + slots_ - age) % slots_ * components_;
    };
    if (first) {
      *newest = 0;
      for (std::size_t k = 0; k < slots_; ++k) std::copy(values.begin(), values.end(), line + k * components_);
    } else {
      *newest = double((std::size_t(*newest) + 1) % slots_);
      std::copy(values.begin(), values.end(), slot(0));
    }
    std::copy_n(slot(whole_), components_, values.begin());
  }

 private:
  std::size_t components_ = 0, slots_ = 0, whole_ = 0, state_ = 0;
};

}  // namespace muro
