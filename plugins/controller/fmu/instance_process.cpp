// SPDX-License-Identifier: MIT
#include "instance_process.hpp"

#include <cerrno>
#include <csignal>
#include <cstring>
#include <filesystem>

#include "component.hpp"
#include "muro/base/number_text.hpp"
#include "plugins/common/child_process/as_child.hpp"
#include "plugins/common/child_process/own_folder.hpp"
#include "remote_protocol.hpp"

namespace muro::fmu {

namespace {

using Transfer = ChildProcess::Transfer;

}  // namespace

InstanceProcess::InstanceProcess(double timeout) : timeout_(timeout) {
  const std::string program = (std::filesystem::path(own_folder()) / "controllers" / process_file).string();
  if (const int code = process_.start({.program = program}); code != 0)
    throw Error("the program for a process of its own, " + program + ", cannot be started: " + std::strerror(code) +
                (code == ENOENT || code == EACCES ? "; install muro again" : ""));
  Greeting greeting;
  const Greeting ours;
  receive(&greeting, sizeof greeting);
  if (std::memcmp(&greeting, &ours, sizeof ours) != 0)
    throw Error("the program for a process of its own, " + program + ", is of another muro; install muro again");
}

ChildProcess::Clock::time_point InstanceProcess::deadline() const {
  using Clock = ChildProcess::Clock;
  return Clock::now() + std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(timeout_));
}

std::vector<std::byte> InstanceProcess::ask(std::span<const std::byte> request) {
  const std::uint64_t size = request.size();
  // receive() detects that the process has ended
  if (process_.send(&size, sizeof size, deadline()) == Transfer::whole)
    process_.send(request.data(), request.size(), deadline());
  std::uint64_t answer_size = 0;
  receive(&answer_size, sizeof answer_size);
  if (answer_size > largest_message) throw Error("its process " + reap().text + " after an answer that makes no sense");
  std::vector<std::byte> answer(answer_size);
  receive(answer.data(), answer.size());
  return answer;
}

void InstanceProcess::receive(void* data, std::size_t size) {
  const Transfer how = process_.receive(data, size, deadline());
  if (how == Transfer::whole) return;
  const Death death = reap();
  if (how == Transfer::late)
    throw FailureFromOutside("it did not return within `timeout` of " + number_text(timeout_) + " s");
  if (death.may_be_from_outside) throw FailureFromOutside("its process " + death.text);
  throw Error("its process " + death.text);
}

InstanceProcess::Death InstanceProcess::reap() {
  if (!process_) return {"is gone"};
  const ChildProcess::End end = process_.end(std::chrono::milliseconds(100));
  if (end.may_be_from_outside())
    return {"was killed by " + name_of_signal(end.signal) + ", from outside or by the system for want of memory", true};
  if (end.signal != 0) return {"was killed by " + name_of_signal(end.signal)};
  if (end.exit_code < 0) return {"has ended"};
  if (end.exit_code == as_child::exit_without_socket) return {"has closed its socket to the simulation"};
  return {"has ended with exit code " + std::to_string(end.exit_code)};
}

}  // namespace muro::fmu
