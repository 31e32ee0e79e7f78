// SPDX-License-Identifier: MIT
#include "core/schedule/trial.hpp"

#include <algorithm>
#include <utility>

namespace muro {

namespace {

constexpr std::uint32_t shortest_pause = 128, longest_pause = 1u << 12;
constexpr std::uint32_t window = 64, calm = 4;  // windows without doubt, after which threads are trusted again

}  // namespace

void Trial::learn(std::uint64_t passed) {
  constexpr double worth = 0.97;    // of the time on one thread
  constexpr double clearly = 0.75;  // the same: an answer that holds for longer
  constexpr double hopeless = 1.5;  // the same, of a whole trial; one run counts no more than `hiccup` times
  constexpr double hiccup = 4;
  constexpr double grown = 1.1;  // work that takes so much longer on one thread
  ++runs_;
  if (state_ == State::settled) {
    if (parallel_) watch(double(passed));
    if (runs_ >= pause_) enter(State::serial);
    return;
  }
  constexpr std::uint32_t all = warm + counted;
  watched_ += std::min(double(passed), hiccup * serial_);
  const bool given_up = state_ == State::parallel && watched_ > hopeless * all * serial_;
  if (runs_ > warm) seen_[runs_ - warm - 1] = double(passed);
  if (runs_ < all && !given_up) return;
  std::nth_element(seen_.begin(), seen_.begin() + counted / 2, seen_.end());
  const double median = seen_[counted / 2];
  if (state_ == State::parallel) {
    const bool clear = !given_up && median < clearly * serial_;
    return settle(!given_up && median < worth * serial_, clear ? 4 * shortest_pause : shortest_pause);
  }
  serial_ = median;
  const double doubted = std::exchange(doubted_, 0);
  if (doubted > 0 && doubted * grown >= serial_) {  // no more to do than before: threads are held up
    distrust_ = std::clamp(4 * distrust_, shortest_pause, longest_pause);
    settle(false, distrust_);
    return;
  }
  enter(State::parallel);
}

void Trial::enter(State state) {
  state_ = state;
  runs_ = 0;
  watched_ = 0;
}

void Trial::settle(bool better, std::uint32_t first_pause) {
  pause_ = known_ && better == parallel_ ? std::min(4 * pause_, longest_pause) : first_pause;
  known_ = true;
  parallel_ = better;
  enter(State::settled);
}

/// A machine that is busy with other things may put a worker aside in the midst of its work, which a short trial does
/// not see. Or there is more to do than at the last trial. A look at one thread tells: see learn().
void Trial::watch(double passed) {
  watched_ += std::min(passed, 0.25 * window * serial_);  // one hiccup decides nothing
  if (runs_ % window != 0) return;
  if (std::exchange(watched_, 0) <= window * serial_) {
    if (runs_ > calm * window) distrust_ = 0;
    return;
  }
  doubted_ = serial_;
  enter(State::serial);
}

}  // namespace muro
