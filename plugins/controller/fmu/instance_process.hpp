// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "plugins/common/child_process/child_process.hpp"

namespace muro::fmu {

/// A process for one instance of an FMU. It ends with this object, and when the process that has started it ends. All
/// processes that it has started end with it.
class InstanceProcess {
 public:
  /// `timeout`: limit for each request, s of wall-clock time. Throws Error.
  explicit InstanceProcess(double timeout);
  ~InstanceProcess() { reap(); }  // waits for its last output
  InstanceProcess(const InstanceProcess&) = delete;
  InstanceProcess& operator=(const InstanceProcess&) = delete;

  /// Sends a request and returns the answer. Throws Error when there is none, with the end of the process; throws
  /// FailureFromOutside when the clock or another process has influenced it.
  std::vector<std::byte> ask(std::span<const std::byte> request);
  bool is_running() const { return bool(process_); }

  struct Death {
    std::string text;  ///< the end of a sentence: "was killed by SIGSEGV"
    bool may_be_from_outside = false;
  };
  /// Ends the process if it still runs, and returns how it has ended.
  Death reap();

 private:
  ChildProcess::Clock::time_point deadline() const;
  void receive(void* data, std::size_t size);

  double timeout_;
  ChildProcess process_;
};

}  // namespace muro::fmu
