// SPDX-License-Identifier: MIT
#pragma once

#include <array>
#include <cstdint>

namespace muro {

/// Finds out, now and then, whether runs of a program take less time on several threads: some runs on one thread, then
/// as many on several. In between it watches what several threads need. Time decides who computes a result, never what
/// it is.
class Trial {
 public:
  /// Whether the next run is for several threads.
  bool parallel() const { return state_ == State::settled ? parallel_ : state_ == State::parallel; }
  /// The run that followed took so many ticks.
  void learn(std::uint64_t passed);

 private:
  enum class State : std::uint8_t { serial, parallel, settled };
  static constexpr std::uint32_t warm = 2, counted = 5;  ///< runs of each way

  void watch(double passed);
  void enter(State state);
  void settle(bool better, std::uint32_t first_pause);

  State state_ = State::serial;
  bool known_ = false;          ///< `parallel_` is the answer of a trial
  bool parallel_ = false;       ///< the way that is taken once settled
  std::uint32_t runs_ = 0;      ///< in the present state
  std::uint32_t pause_ = 0;     ///< runs until the next trial; four times as long while the answer stays the same
  std::uint32_t distrust_ = 0;  ///< runs on one thread after a trial that promised too much; grows likewise
  double doubted_ = 0;          ///< what `serial_` was when threads turned out to be slower; 0: no doubt
  double serial_ = 0;           ///< ticks of a run on one thread
  double watched_ = 0;          ///< ticks of runs since the last look, or of a trial
  std::array<double, counted> seen_{};
};

}  // namespace muro
