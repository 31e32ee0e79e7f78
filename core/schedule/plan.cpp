// SPDX-License-Identifier: MIT
#include "core/schedule/plan.hpp"

#include <algorithm>
#include <utility>

namespace muro {

namespace {

constexpr std::uint32_t min_interval = 128, max_interval = 1u << 12;
constexpr std::uint32_t window = 64, calm = 4;  // windows without suspicion, after which threads are trusted again

}  // namespace

void Plan::Tuner::learn(std::uint64_t duration) {
  constexpr double worth = 0.97;        // of the time on one thread
  constexpr double clearly = 0.75;      // the same: a result that holds for longer
  constexpr double hopeless = 1.5;      // the same, of a whole trial
  constexpr double max_outlier = 4;     // one run of a trial counts no more than so many serial ones
  constexpr double growth_limit = 1.1;  // work that takes so much longer on one thread has grown
  ++runs_;
  if (state_ == State::settled) {
    parallel_ ? watch(double(duration)) : watch_growth(double(duration));
    if (runs_ >= interval_) enter(State::serial);
    return;
  }
  constexpr std::uint32_t all = warm_up + counted;
  total_ += std::min(double(duration), max_outlier * serial_);
  const bool given_up = state_ == State::parallel && total_ > hopeless * all * serial_;
  if (runs_ > warm_up) durations_[runs_ - warm_up - 1] = double(duration);
  if (runs_ < all && !given_up) return;
  std::nth_element(durations_.begin(), durations_.begin() + counted / 2, durations_.end());
  const double median = durations_[counted / 2];
  if (state_ == State::parallel) {
    const bool clear = !given_up && median < clearly * serial_;
    return settle(!given_up && median < worth * serial_, clear ? 4 * min_interval : min_interval);
  }
  serial_ = median;
  const double suspected = std::exchange(suspected_, 0);
  if (suspected > 0 && suspected * growth_limit >= serial_) {  // no more work than before: threads are held up
    backoff_ = std::clamp(4 * backoff_, min_interval, max_interval);
    settle(false, backoff_);
    return;
  }
  enter(State::parallel);
}

void Plan::Tuner::enter(State state) {
  state_ = state;
  runs_ = 0;
  total_ = 0;
}

void Plan::Tuner::settle(bool parallel, std::uint32_t first_interval) {
  interval_ = known_ && parallel == parallel_ ? std::min(4 * interval_, max_interval) : first_interval;
  known_ = true;
  parallel_ = parallel;
  if (parallel) growth_windows_ = 1;
  enter(State::settled);
}

/// A machine that is busy with other things may suspend a worker in the midst of its work, which a short trial does not
/// see. Or there is more work than at the last trial. A look at one thread tells: see learn().
void Plan::Tuner::watch(double duration) {
  total_ += std::min(duration, 0.25 * window * serial_);  // one outlier decides nothing
  if (runs_ % window != 0) return;
  if (std::exchange(total_, 0) <= window * serial_) {
    if (runs_ > calm * window) backoff_ = 0;
    return;
  }
  suspected_ = serial_;
  enter(State::serial);
}

/// What one thread did fast enough may be more by now, as when robots meet, and worth several. Where the next trial
/// finds that it is not, the look after it takes twice as long.
void Plan::Tuner::watch_growth(double duration) {
  constexpr double growth = 1.5;
  total_ += std::min(duration, 0.25 * window * serial_);  // one outlier decides nothing
  const std::uint32_t runs = window * growth_windows_;
  if (runs_ % runs != 0 || std::exchange(total_, 0) <= growth * runs * serial_) return;
  growth_windows_ = std::min(2 * growth_windows_, max_interval / window);
  enter(State::serial);
}

}  // namespace muro
