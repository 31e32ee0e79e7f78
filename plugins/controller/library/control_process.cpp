// SPDX-License-Identifier: MIT
#include "control_process.hpp"

#include <fcntl.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <filesystem>

#include "plugins/common/child_process/as_child.hpp"
#include "plugins/common/child_process/own_folder.hpp"
#include "plugins/common/text/one_line.hpp"
#include "process_protocol.hpp"

namespace muro::control {

namespace {

using Clock = std::chrono::steady_clock;
using Transfer = ChildProcess::Transfer;

std::string meaning_of(int signal) {
  const std::string text = name_of_signal(signal);
  switch (signal) {
    case SIGSEGV:
      return text + ", invalid memory access";
    case SIGBUS:
      return text + ", access behind the end of a file";
    case SIGFPE:
      return text + ", integer division by zero, or overflow";
    case SIGILL:
      return text + ", invalid instruction";
    case SIGABRT:
      return text + ", it gave up by abort()";
    case SIGKILL:
      return text + ", maybe because the system was short of memory, or because somebody killed it";
    default:
      return text;
  }
}

Outcome outcome_of(const ChildProcess::End& end) {
  if (end.signal != 0)
    return {.ending = Ending::crashed, .reason = meaning_of(end.signal), .is_from_outside = end.may_be_from_outside()};
  if (end.exit_code < 0) return {.ending = Ending::crashed, .reason = "nobody knows how"};
  return {.ending = Ending::exited,
          .reason = end.exit_code == as_child::exit_without_socket ? "it has closed the socket to the simulation"
                                                                   : "exit code " + std::to_string(end.exit_code)};
}

}  // namespace

ControlProcess::ControlProcess(const std::string& library, const ProcessLimits& limits)
    : library_(library), limits_(limits) {
  start();
  Writer request;
  request.text(library);
  const std::vector<std::byte> answer = ask(request.bytes());
  Reader reader(answer);
  table_ = read_table(reader);
}

void ControlProcess::start() {
  const std::string program = (std::filesystem::path(own_folder()) / "controllers" / process_file).string();
  const auto fail = [&](int code) {
    throw ProcessError("cannot run in a process of its own (`isolate: process`): " + program +
                       " cannot be started: " + std::strerror(code) +
                       (code == ENOENT || code == EACCES || code == ENOEXEC ? "; install muro again"
                        : code == EMFILE ? "; a process for each robot takes three files, `ulimit -n` allows more"
                                         : ""));
  };
  int ends[2];
  // output that does not fit into the pipe is lost: the control code never waits for a reader
  if (pipe2(ends, O_CLOEXEC | O_NONBLOCK) != 0) fail(errno);
  output_.reset(ends[0]);
  const Descriptor theirs(ends[1]);
  if (!output_.keep_off_standard_streams() || !memory_.create(process_file)) fail(errno);
  const int code = process_.start(
      {.program = program, .files = {{theirs.get(), 1}, {theirs.get(), 2}, {memory_.descriptor(), process_memory}}});
  if (code != 0) fail(code);
  Greeting greeting{};
  const Greeting ours = Greeting::ours();
  const std::string problem = receive(&greeting, sizeof greeting, Clock::now() + std::chrono::seconds(10));
  if (!problem.empty()) throw ProcessError("cannot run in a process of its own: " + program + " " + problem);
  if (std::memcmp(&greeting, &ours, sizeof ours) != 0)
    throw ProcessError("cannot run in a process of its own: " + program + " is of another muro; install muro again");
}

/// Receives bytes. Returns a text about the end of the process when it does not answer.
std::string ControlProcess::receive(void* data, std::uint64_t size, Clock::time_point until) {
  const Transfer how = process_.receive(data, size, until);
  if (how == Transfer::whole) return "";
  const Outcome death = end(how == Transfer::late);
  if (how == Transfer::late) return "did not return in time";
  return (death.ending == Ending::exited ? "ended its process" : "crashed") +
         (death.reason.empty() ? "" : ": " + death.reason) +
         (death.stack.empty() ? "" : "; its calls: " + one_line(death.stack));
}

std::vector<std::byte> ControlProcess::ask(std::span<const std::byte> request) {
  // loading a library from a slow disk is not limited as a call of control code
  const double seconds = std::max(limits_.timeout, 10.0);
  const auto until = Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(seconds));
  const MessageHeader size{request.size(), 0};
  // receive() detects that the process has ended
  if (process_.send(&size, sizeof size, until) == Transfer::whole) process_.send(request.data(), request.size(), until);
  MessageHeader header;
  std::string problem = receive(&header, sizeof header, until);
  std::vector<std::byte> answer(problem.empty() ? std::min<std::uint64_t>(header.size, 64u << 20) : 0);
  if (problem.empty()) problem = receive(answer.data(), answer.size(), until);
  if (!problem.empty()) throw ProcessError("library " + library_ + " " + problem + " when it was loaded");
  if (header.is_refusal != 0) throw Error(std::string(reinterpret_cast<const char*>(answer.data()), answer.size()));
  return answer;
}

void ControlProcess::prepare(std::span<const std::byte> message) {
  ask(message);
  memory_.close();  // both processes have mapped it
}

Outcome ControlProcess::end(bool timed_out) {
  if (!process_) return {.ending = Ending::no_process};
  if (timed_out) {
    process_.signal(SIGALRM);
    process_.ends_within(std::chrono::seconds(1));
  }
  Outcome death = outcome_of(process_.end());
  death.stack = process_.take_rest(32768);
  while (death.stack.ends_with('\n')) death.stack.pop_back();
  if (timed_out) {
    death.ending = Ending::timed_out;
    death.is_from_outside = false;
  }
  return death;
}

std::string ControlProcess::take_output() {
  constexpr std::size_t most = 64 * 1024;
  std::string text;
  char some[4096];
  for (ssize_t got = 0; text.size() < most && (got = read(output_.get(), some, sizeof some)) > 0;)
    text.append(some, std::size_t(got));
  return text;
}

}  // namespace muro::control
