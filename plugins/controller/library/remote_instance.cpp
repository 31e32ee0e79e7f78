// SPDX-License-Identifier: MIT
#include "remote_instance.hpp"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <new>
#include <string_view>
#include <thread>

#include "process_protocol.hpp"

namespace muro::control {

namespace {

using Clock = std::chrono::steady_clock;
using namespace std::chrono_literals;

/// Time that a side polls for its turn before it sleeps: longer than most steps, but short for a processor.
constexpr std::chrono::nanoseconds spin = 50us;
/// Time after which a sleeping side checks whether the other side still runs.
constexpr std::chrono::nanoseconds nap = 5ms;
constexpr std::uint32_t most_lines_a_call = 20, most_lines = 1000;

std::vector<std::uint32_t> sizes_of(std::span<const Port> ports) {
  std::vector<std::uint32_t> sizes;
  for (const Port& p : ports) sizes.push_back(p.size());
  return sizes;
}

}  // namespace

RemoteInstance::RemoteInstance(std::unique_ptr<ControlProcess> process, const ControlTable& table,
                               const InstanceSetup& setup, std::span<const Port> inputs, std::span<const Port> outputs,
                               LogSink log)
    : process_(std::move(process)),
      has_instances_(table.has_instances),
      input_sizes_(sizes_of(inputs)),
      output_sizes_(sizes_of(outputs)),
      layout_(table, input_sizes_, output_sizes_),
      log_(log),
      patience_(std::thread::hardware_concurrency() > 1 ? spin : 0ns) {
  if (!process_->memory().resize(layout_.size()))
    throw ProcessError("cannot run in a process of its own: " + std::to_string(layout_.size()) +
                       " bytes of memory to share with it are not there");
  new (process_->memory().data()) SharedHeader;
  memory_ = layout_.memory(process_->memory().data());
  // with more processes than processors, a polling process would delay the one that has the turn
  const bool may_spin = setup.count < std::max(2u, std::thread::hardware_concurrency());
  Writer message;
  write(Preparation{.setup = setup,
                    .input_sizes = input_sizes_,
                    .output_sizes = output_sizes_,
                    .memory = process_->limits().memory,
                    .spin_nanoseconds = may_spin ? std::uint64_t(spin.count()) : 0},
        message);
  process_->prepare(message.bytes());
  hand_on_output();
}

RemoteInstance::~RemoteInstance() {
  if (is_alive_ && has_instances_) call({.function = Function::destroy});
}

bool RemoteInstance::wait(bool is_patient, bool& timed_out) {
  const auto until = Clock::now() + std::chrono::duration_cast<Clock::duration>(
                                        std::chrono::duration<double>(process_->limits().timeout));
  while (!header().turn.wait_for(Turn::Side::caller, patience_, nap)) {
    if (!process_->is_alive()) return false;
    timed_out = !is_patient && Clock::now() >= until;
    if (timed_out) return false;
  }
  return true;
}

Outcome RemoteInstance::call(const Call& call) {
  SharedHeader& h = header();
  h.function = call.function;
  h.time = call.time, h.period = call.period, h.seed = call.seed, h.index = call.index;
  if (!memory_.input_sizes.empty())
    std::memcpy(layout_.input_sizes_in(process_->memory().data()), memory_.input_sizes.data(),
                memory_.input_sizes.size() * sizeof(std::uint32_t));
  h.in_function[0] = 0;
  h.is_short_of_memory = 0;
  h.turn.pass_to(Turn::Side::callee);
  bool timed_out = false;
  if (!wait(call.is_patient, timed_out)) return death(timed_out);
  hand_on_log();
  hand_on_output();
  if (h.ending == Ending::fine) return {};
  Outcome outcome{.ending = h.is_short_of_memory != 0 ? Ending::out_of_memory : h.ending};
  h.in_function[sizeof h.in_function - 1] = h.reason[sizeof h.reason - 1] = 0;
  outcome.function = h.in_function;
  outcome.reason = h.reason;
  return outcome;
}

/// Returns the end of the process. Passes on its last output; the stack is in the outcome.
Outcome RemoteInstance::death(bool timed_out) {
  Outcome outcome = process_->end(timed_out);
  is_alive_ = false;
  hand_on_log();
  hand_on_output();
  SharedHeader& h = header();
  h.in_function[sizeof h.in_function - 1] = 0;
  outcome.function = h.in_function;
  if (outcome.ending == Ending::crashed && h.fault_address != ~std::uint64_t(0) && h.signal != 0) {
    char address[32];
    std::snprintf(address, sizeof address, " at 0x%llx", static_cast<unsigned long long>(h.fault_address));
    outcome.reason += address;
  }
  if (outcome.ending == Ending::timed_out) return outcome;
  if (h.is_short_of_memory != 0) outcome.ending = Ending::out_of_memory;
  if (h.is_signal_of_others != 0) outcome.is_from_outside = true;
  return outcome;
}

void RemoteInstance::hand_on_log() {
  SharedHeader& h = header();
  const std::size_t size = std::min<std::size_t>(h.log_size, sizeof h.log);
  for (std::size_t at = 0; at + 1 < size;) {
    const auto level = std::uint32_t(h.log[at++]);
    const std::string text(h.log + at, strnlen(h.log + at, size - at));
    log_.write(log_.context, level, text.c_str());
    at += text.size() + 1;
  }
  if (h.log_lost > 0) {
    const std::string text = "(" + std::to_string(h.log_lost) + " lines more, for which there was no room)";
    log_.write(log_.context, MURO_LOG_WARNING, text.c_str());
  }
  h.log_size = h.log_lost = 0;
}

void RemoteInstance::hand_on_output() {
  const std::string text = process_->take_output();
  std::string_view rest = text;
  for (std::uint32_t lines = 0; !rest.empty() && printed_lines_ <= most_lines; ++lines, ++printed_lines_) {
    const std::size_t end = std::min(rest.find('\n'), rest.size());
    const bool too_many = lines == most_lines_a_call || printed_lines_ == most_lines;
    const std::string line =
        too_many ? "(prints more, which is left out)" : "(prints) " + std::string(rest.substr(0, end));
    log_.write(log_.context, MURO_LOG_INFO, line.c_str());
    if (too_many) rest = {};
    rest.remove_prefix(std::min(end + 1, rest.size()));
  }
}

}  // namespace muro::control
