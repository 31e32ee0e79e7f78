// SPDX-License-Identifier: MIT
#include "stepper.hpp"

#include <algorithm>
#include <cmath>

#include "muro/algorithm.hpp"
#include "plugins/common/model_file/message.hpp"

namespace muro::fmu {

namespace {

using model_file::shortest;

constexpr int most_parts = 1000;        ///< parts of one communication step
constexpr double smallest_part = 1e-6;  ///< fraction of one communication step; smaller parts are rounding errors

std::string seconds(double s) { return shortest(s) + " s"; }
/// Writes a time without rounding errors of summed periods: times of a simulation are whole nanoseconds.
std::string instant(double s) { return seconds(std::round(1e9 * s) / 1e9); }

[[noreturn]] void refuse(const std::string& what, const std::string& flag, const std::string& why) {
  throw Error(what + ", and the FMU lacks the flag " + flag + ", which " + why +
              "; a higher rate makes communication steps smaller");
}

bool is_multiple(double size, double of) {
  const double multiple = size / of, whole = std::max(1.0, std::round(multiple));
  return std::abs(multiple - whole) <= 1e-6 * whole;
}

}  // namespace

std::string advice_on_step_size(const ModelDescription& d, double size) {
  if (d.variable_step_size || d.preferred_step <= 0 || is_multiple(size, d.preferred_step)) return "";
  return "it prefers communication steps of " + seconds(d.preferred_step) +
         " (stepSize) and lacks the flag canHandleVariableCommunicationStepSize, and the period is " + seconds(size) +
         "; results may be wrong";
}

void check_step_size(const ModelDescription& d, double size) {
  if (d.fixed_internal_step <= 0 || is_multiple(size, d.fixed_internal_step)) return;
  std::string rates;
  for (const double n : {1.0, 2.0, 5.0, 10.0})
    rates += (rates.empty() ? "" : ", ") + shortest(std::round(1e6 / (n * d.fixed_internal_step)) / 1e6);
  throw Error("its fixedInternalStepSize is " + seconds(d.fixed_internal_step) +
              ", and the period must be a multiple of it; it is " + seconds(size) + ". Set `rate` to 1 / (n * " +
              shortest(d.fixed_internal_step) + " s) with a whole n, such as " + rates + " Hz");
}

void advance(Component& component, const ModelDescription& d, double begin, double end, double size,
             const std::function<void()>& set_inputs) {
  const bool can_return = d.version == 3 || d.can_keep_state;  // FMI 3: a discarded step does not change the state
  const bool keeps_state = d.version == 2 && d.can_keep_state && d.variable_step_size;
  const double least = smallest_part * size;
  double at = begin, part = size;
  if (keeps_state) component.keep_state();
  for (int parts = 1;; ++parts) {
    const StepOutcome o = component.do_step(at, part);
    const auto where = [&] { return "between t = " + instant(at) + " and " + instant(at + part); };
    if (o.wants_end)
      throw Error(std::string("the FMU asks to end the simulation (") +
                  (d.version == 2 ? "fmi2Terminated" : "terminateSimulation") + ") " + where());
    if (o.needs_event)
      throw Error("the FMU asks for event mode (eventHandlingNeeded) " + where() +
                  "; it was told that there is none (eventModeUsed is false), so it is to handle events itself");
    if (parts >= most_parts)
      throw Error("the FMU needs more than " + std::to_string(most_parts) + " parts for the communication step " +
                  where());
    if (o.is_discarded) {
      const std::string what = "the FMU discards the communication step " + where();
      if (!d.variable_step_size)
        refuse(what, "canHandleVariableCommunicationStepSize", "a repetition with smaller steps needs");
      if (!can_return) refuse(what, d.flag_of_state("GetAndSet"), "a repetition with smaller steps needs");
      const bool got_on = o.knows_last_time && o.last_time > at + least && o.last_time < at + part - least;
      part = got_on ? o.last_time - at : part / 2;
      if (part < least) throw Error(what + ", and all smaller ones");
      if (d.version == 2) component.return_to_state();
      set_inputs();
      continue;
    }
    if (o.returned_early) {
      if (!d.variable_step_size)
        refuse("the FMU returns early from the communication step " + where(), "canHandleVariableCommunicationStepSize",
               "the rest of the step needs");
      if (!(o.last_time >= at) || !(o.last_time <= at + part + least))
        throw Error("the FMU returns early " + where() + " and says it is at t = " + seconds(o.last_time));
      at = o.last_time;
    } else {
      at += part;
    }
    part = end - at;
    if (part <= least) return;
    if (keeps_state) component.keep_state();
  }
}

}  // namespace muro::fmu
