// SPDX-License-Identifier: MIT
#pragma once

#include <string>
#include <string_view>

#include "control_instance.hpp"
#include "muro/ext/external_inputs.hpp"

namespace muro::control {

/// The failures of a process of control code, which depend on more than the scenario: on the clock and the memory of
/// the machine. They are recorded as inputs from outside. A replay gives them back at the instants at which they were.
class FailureLog {
 public:
  /// `channel`: the name under which they are recorded, the same in each run. [setup]
  FailureLog(ExternalInputs& inputs, const std::string& channel) : inputs_(inputs), channel_(inputs.channel(channel)) {}

  bool is_replayed() const { return channel_ && channel_->is_replayed(); }
  /// In a replay: how the call of `function` at `time` (ns) failed in the recorded run; null where it did not. Valid
  /// until the next call of this. [step]
  const Outcome* replayed(std::int64_t time, Function function);
  /// Records an outcome that is such a failure. `who` begins the sentence that says why the run cannot be repeated
  /// without the recording. [step]
  void record(std::int64_t time, Function function, const Outcome& outcome, const std::string& who);
  void tell_not_repeatable(const std::string& why) { inputs_.not_repeatable(why); }
  /// Time jumps. [between steps]
  void begin_anew() { next_time_ = -1; }

 private:
  ExternalInputs& inputs_;
  InputChannel* channel_;        ///< null: another one has the name, and nothing is recorded
  std::int64_t next_time_ = -1;  ///< ns, of what was taken from the recording last; -1: nothing
  Function next_function_ = Function::step;
  Outcome next_;
  std::string function_;  ///< of the library, for `next_`
};

}  // namespace muro::control
