// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace muro {

/// Which chains each thread begins with, in all stages that have so many chains: equally many at first, then by what
/// they are seen to cost.
///
/// Blocks of robots cost differently much, by what their robots meet. A chain that moves to another thread has to fetch
/// its data from the cache of another core: one change at a time is made, and only one that pays.
class Balance {
 public:
  Balance(std::uint32_t chains, unsigned threads);

  /// Another stage with these chains; returns its number.
  std::uint32_t add_stage();
  /// The chains, thread by thread, and where those of each thread end.
  std::span<const std::uint32_t> order() const { return order_; }
  std::span<const std::uint32_t> ends() const { return ends_; }
  /// What a chain has cost just now, in ticks. [any thread; a chain on one thread at a time]
  void add_cost(std::uint32_t stage, std::uint32_t chain, std::uint64_t ticks);
  /// Gives a chain to another thread, or exchanges two, where the stages together would end noticeably earlier by it.
  /// [while no chain runs]
  void improve();

 private:
  struct Cost {
    double sum = 0;   ///< ticks; of earlier times by half
    double last = 0;  ///< ticks
  };
  struct Change {
    std::uint32_t chain = 0, other = 0;  ///< equal: the chain alone moves
    unsigned thread = 0;                 ///< to which the first one goes
  };
  unsigned threads() const { return unsigned(ends_.size()); }
  const Cost& cost(std::size_t stage, std::uint32_t chain) const { return costs_[stage * owner_.size() + chain]; }
  unsigned count_loads();
  void count_rest(unsigned from, unsigned to);
  bool gets_shorter_than(double& shortest, unsigned from, const Change& change) const;
  void sort();

  std::vector<unsigned> owner_;  ///< thread by chain
  std::vector<std::uint32_t> order_, ends_;
  std::vector<Cost> costs_;    ///< by stage and chain
  std::vector<double> loads_;  ///< ticks, by stage and thread
  std::vector<double> rest_;   ///< ticks, by stage
  double length_ = 0;          ///< ticks, of all stages
};

}  // namespace muro
