// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "muro/step.hpp"

namespace muro {

/// Records which call ran when, and on which thread.
class Timeline {
 public:
  struct Span {
    std::uint32_t task = 0;
    std::uint32_t phase = 0;
    Range range;
    std::int64_t time = 0;             ///< ns, simulated
    std::uint64_t begin = 0, end = 0;  ///< ticks
  };

  /// Records from now on, up to `max_spans` calls of each thread.
  void start(std::size_t max_spans) { max_spans_ = max_spans; }
  bool on() const { return max_spans_ > 0; }
  void set_threads(std::size_t count) { threads_.resize(count); }
  void add(unsigned thread, const Span& span) {
    if (threads_[thread].size() < max_spans_) threads_[thread].push_back(span);
  }
  /// Whether calls were left out.
  bool full() const {
    return std::any_of(threads_.begin(), threads_.end(), [&](const auto& t) { return on() && t.size() == max_spans_; });
  }
  /// The recorded calls by thread, in the order in which they ran.
  const std::vector<std::vector<Span>>& threads() const { return threads_; }

 private:
  std::size_t max_spans_ = 0;
  std::vector<std::vector<Span>> threads_ = std::vector<std::vector<Span>>(1);
};

}  // namespace muro
