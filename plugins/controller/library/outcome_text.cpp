// SPDX-License-Identifier: MIT
#include "outcome_text.hpp"

#include "muro/base/number_text.hpp"
#include "plugins/common/text/one_line.hpp"
#include "plugins/common/text/quote.hpp"

namespace muro::control {

std::string text_of(const Outcome& outcome, bool is_isolated, const ProcessLimits& limits) {
  const std::string in = *outcome.function ? " in " + quote(outcome.function) : "";
  const std::string reason = outcome.reason.empty() ? "" : ": " + one_line(outcome.reason);
  switch (outcome.ending) {
    case Ending::fine:
      break;
    case Ending::refused:
      return reason.empty() ? "fails without giving a reason" : "fails" + reason;
    case Ending::threw:
      return "threw an exception out of " + quote(outcome.function) + reason +
             "; functions of control code throw nothing, they return an error";
    case Ending::out_of_memory:
      if (!is_isolated) return "ran out of memory" + in;
      return "ran out of memory" + in + reason + "; its process may take " + std::to_string(limits.memory >> 20) +
             " MiB (`memory`) beside what it has at its start";
    case Ending::crashed:
      return "crashed" + in + reason;
    case Ending::exited:
      return "ended its process" + in + reason;
    case Ending::timed_out:
      return "did not return from " + quote(outcome.function) + " within " + number_text(limits.timeout) +
             " s of wall-clock time (`timeout`)";
    case Ending::no_process:
      return "cannot run" + reason;
  }
  return "has spoilt the memory that it shares with the simulation";
}

}  // namespace muro::control
