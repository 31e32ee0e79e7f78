// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>

#include "control_instance.hpp"
#include "muro/algorithm.hpp"
#include "plugins/common/child_process/child_process.hpp"
#include "plugins/controller/common/shared_call/shared_memory.hpp"

namespace muro::control {

/// What the control code of one robot may take in a process of its own.
struct ProcessLimits {
  double timeout = 5;                                ///< s of wall-clock time for a call
  std::uint64_t memory = std::uint64_t(1024) << 20;  ///< bytes beside what the process has when the library is loaded
};

/// A process cannot be started, or has ended while it was prepared.
class ProcessError : public Error {
 public:
  using Error::Error;
};

/// A process in which a library of control code is loaded, for one instance. It ends when this does, and when the
/// process that has started it is gone, and all that it has started end with it.
class ControlProcess {
 public:
  /// Throws Error when something is wrong with the library, and ProcessError.
  ControlProcess(const std::string& library, const ProcessLimits& limits);

  ControlTable& table() { return table_; }
  SharedMemory& memory() { return memory_; }
  const ProcessLimits& limits() const { return limits_; }

  /// Has it do what stands in a message. Throws ProcessError.
  void prepare(std::span<const std::byte> message);
  bool is_alive() const { return process_.is_running(); }
  /// How it has ended, with what was on its stack. Ends it where it still runs; one that did not return says what it
  /// was doing.
  Outcome end(bool timed_out);
  /// What it has printed since the last call of this, at most 64 KiB.
  std::string take_output();

 private:
  void start();
  std::string receive(void* data, std::uint64_t size, std::chrono::steady_clock::time_point until);
  std::vector<std::byte> ask(std::span<const std::byte> request);

  std::string library_;
  ProcessLimits limits_;
  ChildProcess process_;
  Descriptor output_;
  SharedMemory memory_;
  ControlTable table_;
};

}  // namespace muro::control
