// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "core/schedule/stage.hpp"

namespace muro {

/// The way in which the due tasks of an instant, or of several instants with the same due tasks, are carried out.
struct Plan {
  /// Finds out, now and then, whether runs of a plan take less time on several threads, by a trial: some runs on one
  /// thread, then as many on several. Between trials it watches what several threads need, and whether one gets more to
  /// do. Time decides who computes a result, never what it is.
  class Tuner {
   public:
    /// Whether the next run is for several threads.
    bool parallel() const { return state_ == State::settled ? parallel_ : state_ == State::parallel; }
    /// The run that followed took so many ticks.
    void learn(std::uint64_t duration);

   private:
    enum class State : std::uint8_t { serial, parallel, settled };
    static constexpr std::uint32_t warm_up = 2, counted = 5;  ///< runs of each half of a trial

    void watch(double duration);
    void watch_growth(double duration);
    void enter(State state);
    void settle(bool parallel, std::uint32_t first_interval);

    State state_ = State::serial;
    bool known_ = false;          ///< `parallel_` is the result of a trial
    bool parallel_ = false;       ///< what is done once settled
    std::uint32_t runs_ = 0;      ///< in the present state
    std::uint32_t interval_ = 0;  ///< runs until the next trial; four times as long while the result stays the same
    std::uint32_t growth_windows_ = 1;  ///< after which it is seen whether one thread got more to do
    std::uint32_t backoff_ = 0;  ///< runs on one thread after a trial that promised too much; then grows fourfold
    double suspected_ = 0;       ///< what `serial_` was when threads turned out to be slower; 0: no suspicion
    double serial_ = 0;          ///< ticks of a run on one thread
    double total_ = 0;           ///< ticks of the runs of a window, or of a trial
    std::array<double, counted> durations_{};
  };

  std::vector<Task::Due> due;
  std::vector<Stage> stages;
  Tuner tuner;
};

}  // namespace muro
