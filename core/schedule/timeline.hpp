// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "muro/step.hpp"

namespace muro {

/// Which call ran when on which thread.
class Timeline {
 public:
  struct Span {
    std::uint32_t task = 0;
    std::uint32_t phase = 0;
    Range range;
    std::int64_t time = 0;             ///< ns, simulated
    std::uint64_t begin = 0, end = 0;  ///< ticks
  };

  /// Records from now on, up to `most` calls of each thread.
  void start(std::size_t most) { most_ = most; }
  bool on() const { return most_ > 0; }
  void set_threads(std::size_t count) { threads_.resize(count); }
  void add(unsigned thread, const Span& span) {
    if (threads_[thread].size() < most_) threads_[thread].push_back(span);
  }
  /// Whether calls were left out.
  bool full() const {
    return std::any_of(threads_.begin(), threads_.end(), [&](const auto& t) { return on() && t.size() == most_; });
  }
  /// By thread, in the order in which they ran.
  const std::vector<std::vector<Span>>& threads() const { return threads_; }

 private:
  std::size_t most_ = 0;
  std::vector<std::vector<Span>> threads_ = std::vector<std::vector<Span>>(1);
};

}  // namespace muro
