// SPDX-License-Identifier: MIT
#include "core/schedule/balance.hpp"

#include <algorithm>

namespace muro {

Balance::Balance(std::uint32_t chains, unsigned threads) : owner_(chains), order_(chains), ends_(threads) {
  // The last chains, of which there may be more and larger ones, go to the thread that is at work first: number 0.
  const std::uint32_t used = std::min(threads, chains);
  for (std::uint32_t c = 0; c < chains; ++c) owner_[c] = used - 1 - unsigned(std::uint64_t(c) * used / chains);
  sort();
}

std::uint32_t Balance::add_stage() {
  const auto number = std::uint32_t(costs_.size() / owner_.size());
  costs_.resize(costs_.size() + owner_.size());
  loads_.resize(loads_.size() + ends_.size());
  rest_.push_back(0);
  return number;
}

void Balance::add_cost(std::uint32_t stage, std::uint32_t chain, std::uint64_t ticks) {
  constexpr double hiccup = 4;  // a thread that was put aside in its work says little about the work
  Cost& c = costs_[stage * owner_.size() + chain];
  const double now = double(ticks);
  c.sum += c.last > 0 ? std::min(now, hiccup * c.last) : now;
  c.last = now;
}

void Balance::improve() {
  constexpr double worth = 0.98;  // of the present length
  const unsigned from = count_loads();
  double shortest = worth * length_;
  Change best{.thread = from};
  const auto try_out = [&](const Change& change) {
    if (gets_shorter_than(shortest, from, change)) best = change;
  };
  const auto chains = std::uint32_t(owner_.size());
  for (unsigned t = 0; t < threads(); ++t) {
    if (t == from) continue;
    count_rest(from, t);
    for (std::uint32_t c = 0; c < chains; ++c) {
      if (owner_[c] != from) continue;
      try_out({c, c, t});
      for (std::uint32_t other = 0; other < chains; ++other)
        if (owner_[other] == t) try_out({c, other, t});
    }
  }
  if (best.thread != from) {
    owner_[best.other] = from;
    owner_[best.chain] = best.thread;
    sort();
  }
  for (Cost& c : costs_) c.sum *= 0.5;
}

/// Of all threads, and how long the stages last together. Returns the thread that has most to do.
unsigned Balance::count_loads() {
  std::fill(loads_.begin(), loads_.end(), 0.0);
  for (std::size_t k = 0; k < costs_.size(); ++k)
    loads_[k / owner_.size() * threads() + owner_[k % owner_.size()]] += costs_[k].sum;
  length_ = 0;
  for (auto stage = loads_.begin(); stage != loads_.end(); stage += threads())
    length_ += *std::max_element(stage, stage + threads());
  unsigned busiest = 0;
  double most = 0;
  for (unsigned t = 0; t < threads(); ++t) {
    double load = 0;
    for (std::size_t k = t; k < loads_.size(); k += threads()) load += loads_[k];
    if (load <= most) continue;
    most = load;
    busiest = t;
  }
  return busiest;
}

/// The longest load in each stage, but for those of two threads.
void Balance::count_rest(unsigned from, unsigned to) {
  for (std::size_t stage = 0; stage < rest_.size(); ++stage) {
    double longest = 0;
    for (unsigned t = 0; t < threads(); ++t)
      if (t != from && t != to) longest = std::max(longest, loads_[stage * threads() + t]);
    rest_[stage] = longest;
  }
}

/// Whether the stages together last less long than `shortest` with the change; sets it then. count_rest() has been
/// called for both threads.
bool Balance::gets_shorter_than(double& shortest, unsigned from, const Change& change) const {
  double sum = 0;
  for (std::size_t stage = 0; stage < rest_.size(); ++stage) {
    const double* const loads = loads_.data() + stage * threads();
    const double back = change.other == change.chain ? 0 : cost(stage, change.other).sum;
    const double moved = cost(stage, change.chain).sum - back;
    sum += std::max({rest_[stage], loads[from] - moved, loads[change.thread] + moved});
    if (sum >= shortest) return false;
  }
  shortest = sum;
  return true;
}

void Balance::sort() {
  std::uint32_t at = 0;
  for (unsigned t = 0; t < threads(); ++t) {
    for (std::uint32_t c = 0; c < owner_.size(); ++c)
      if (owner_[c] == t) order_[at++] = c;
    ends_[t] = at;
  }
}

}  // namespace muro
