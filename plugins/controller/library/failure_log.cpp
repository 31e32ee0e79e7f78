// SPDX-License-Identifier: MIT
#include "failure_log.hpp"

#include "process_protocol.hpp"

namespace muro::control {

const Outcome* FailureLog::replayed(std::int64_t time, Function function) {
  if (!is_replayed()) return nullptr;
  ExternalInput input;
  if (next_time_ != time && channel_->replay(time, input)) {
    Reader reader(std::as_bytes(std::span(input.bytes)));
    next_time_ = time;
    next_function_ = Function(input.kind);
    next_.ending = reader.value<Ending>();
    function_ = reader.text();
    next_.reason = reader.text();
    next_.function = function_.c_str();
  }
  return next_time_ == time && next_function_ == function ? &next_ : nullptr;
}

void FailureLog::record(std::int64_t time, Function function, const Outcome& outcome, const std::string& who) {
  const bool is_of_process = outcome.ending == Ending::crashed || outcome.ending == Ending::exited ||
                             outcome.ending == Ending::timed_out || outcome.ending == Ending::out_of_memory;
  if (!is_of_process) return;
  if (outcome.ending == Ending::timed_out)
    tell_not_repeatable(who + "did not return in time, about which the clock of the machine decides");
  if (outcome.is_from_outside) tell_not_repeatable(who + "was ended by a signal from outside: " + outcome.reason);
  if (!channel_ || is_replayed()) return;
  Writer bytes;
  bytes.value(outcome.ending);
  bytes.text(outcome.function);
  bytes.text(outcome.reason);
  const std::string_view text(reinterpret_cast<const char*>(bytes.bytes().data()), bytes.bytes().size());
  channel_->record(time, {.kind = std::uint32_t(function), .bytes = text});
}

}  // namespace muro::control
