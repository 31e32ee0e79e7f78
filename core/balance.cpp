// SPDX-License-Identifier: MIT
#include "core/balance.hpp"

#include <algorithm>

namespace muro {

Balance::Balance(std::uint32_t chains, unsigned threads) : owner_(chains), order_(chains), ends_(threads) {
  // The last chains, of which there may be more and larger ones, go to the thread that is at work first: number 0.
  for (std::uint32_t c = 0; c < chains; ++c) owner_[c] = threads - 1 - unsigned(std::uint64_t(c) * threads / chains);
  sort();
}

std::uint32_t Balance::add_stage() {
  const auto number = std::uint32_t(costs_.size() / owner_.size());
  costs_.resize(costs_.size() + owner_.size());
  loads_.resize(loads_.size() + ends_.size());
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
  count_loads();
  const unsigned from = busiest();
  double shortest = worth * length(nullptr);
  Change best;
  const auto try_out = [&](const Change& change) {
    const double changed = length(&change);
    if (changed >= shortest) return;
    shortest = changed;
    best = change;
  };
  const auto chains = std::uint32_t(owner_.size());
  best.thread = from;
  for (std::uint32_t c = 0; c < chains; ++c) {
    if (owner_[c] != from) continue;
    for (unsigned t = 0; t < threads(); ++t)
      if (t != from) try_out({c, c, t});
    for (std::uint32_t other = 0; other < chains; ++other)
      if (owner_[other] != from) try_out({c, other, owner_[other]});
  }
  if (best.thread != from) {
    owner_[best.other] = from;
    owner_[best.chain] = best.thread;
    sort();
  }
  for (Cost& c : costs_) c.sum *= 0.5;
}

void Balance::count_loads() {
  std::fill(loads_.begin(), loads_.end(), 0.0);
  for (std::size_t k = 0; k < costs_.size(); ++k)
    loads_[k / owner_.size() * threads() + owner_[k % owner_.size()]] += costs_[k].sum;
}

unsigned Balance::busiest() const {
  unsigned found = 0;
  double most = 0;
  for (unsigned t = 0; t < threads(); ++t) {
    double load = 0;
    for (std::size_t k = t; k < loads_.size(); k += threads()) load += loads_[k];
    if (load <= most) continue;
    most = load;
    found = t;
  }
  return found;
}

/// Until the last thread is done, over all stages.
double Balance::length(const Change* change) const {
  double sum = 0;
  for (std::size_t first = 0, stage = 0; first < loads_.size(); first += threads(), ++stage) {
    const double moved = !change ? 0.0
                                 : cost(stage, change->chain).sum -
                                       (change->other == change->chain ? 0 : cost(stage, change->other).sum);
    double longest = 0;
    for (unsigned t = 0; t < threads(); ++t) {
      double load = loads_[first + t];
      if (change && t == owner_[change->chain]) load -= moved;
      if (change && t == change->thread) load += moved;
      longest = std::max(longest, load);
    }
    sum += longest;
  }
  return sum;
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
