// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "control_instance.hpp"
#include "muro/ext/external_inputs.hpp"

namespace muro::control {

/// The failures of a process of control code. They depend on more than the scenario: on the clock and the memory of the
/// machine. They are recorded as external inputs. A replay returns them at the same instants.
class FailureLog {
 public:
  /// `channel`: name of the recording, the same in each run. [setup]
  FailureLog(ExternalInputs& inputs, const std::string& channel) : inputs_(inputs), channel_(inputs.channel(channel)) {}

  bool is_replayed() const { return channel_ && channel_->is_replayed(); }
  /// Returns, in a replay, how the call of `function` at `time` (ns) failed in the recorded run; null when it did not.
  /// Valid until the next call. [step]
  const Outcome* replayed(std::int64_t time, Function function);
  /// Records an outcome that is such a failure. `who`: begin of the sentence that explains why the run cannot be
  /// repeated without the recording. [step]
  void record(std::int64_t time, Function function, const Outcome& outcome, const std::string& who);
  void tell_not_repeatable(const std::string& why) { inputs_.not_repeatable(why); }
  /// Handles a jump of time. [between steps]
  void begin_anew() { next_time_ = -1; }

 private:
  ExternalInputs& inputs_;
  InputChannel* channel_;        ///< null: the name is in use, and nothing is recorded
  std::int64_t next_time_ = -1;  ///< time of the last entry taken from the recording, ns; -1: none
  Function next_function_ = Function::step;
  Outcome next_;
  std::string function_;  ///< library function of `next_`
};

}  // namespace muro::control
