// SPDX-License-Identifier: MIT
#pragma once

#include <chrono>
#include <string>

#include "control_instance.hpp"
#include "muro/algorithm.hpp"
#include "plugins/common/child_process/child_process.hpp"
#include "plugins/controller/common/shared_call/shared_memory.hpp"

namespace muro::control {

/// Limits for the control code of one robot in a separate process.
struct ProcessLimits {
  double timeout = 5;                                ///< longest call, s of wall-clock time
  std::uint64_t memory = std::uint64_t(1024) << 20;  ///< bytes beyond what it has with the library loaded
};

/// A process cannot be started, or has ended during preparation.
class ProcessError : public Error {
 public:
  using Error::Error;
};

/// A process in which a library of control code is loaded, for one instance. It ends with this object, and when the
/// process that has started it ends. All processes that it has started end with it.
class ControlProcess {
 public:
  /// Starts the process. Throws Error when something is wrong with the library, and ProcessError.
  ControlProcess(const std::string& library, const ProcessLimits& limits);

  ControlTable& table() { return table_; }
  SharedMemory& memory() { return memory_; }
  const ProcessLimits& limits() const { return limits_; }

  /// Makes the process carry out a message. Throws ProcessError.
  void prepare(std::span<const std::byte> message);
  bool is_alive() const { return process_.is_running(); }
  /// Ends the process if it still runs. Returns how it has ended, with the calls on its stack. After a time-out it is
  /// first asked for its stack.
  Outcome end(bool timed_out);
  /// Returns the output that the process has printed since the last call, at most 64 KiB.
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
