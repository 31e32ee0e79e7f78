// SPDX-License-Identifier: MIT
#pragma once

#include <sys/types.h>

#include <cstddef>
#include <span>
#include <string>
#include <vector>

#include "plugins/common/shared_call/descriptor.hpp"

namespace muro::fmu {

/// A process for one instance of an FMU. It ends when this does, and when the process that has started it is gone.
class InstanceProcess {
 public:
  /// `timeout`: s of wall-clock time for each request. Throws Error.
  explicit InstanceProcess(double timeout);
  ~InstanceProcess();
  InstanceProcess(const InstanceProcess&) = delete;
  InstanceProcess& operator=(const InstanceProcess&) = delete;

  /// Sends a request and returns the answer. Throws Error when there is none, with what became of the process.
  std::vector<std::byte> ask(std::span<const std::byte> request);
  bool is_running() const { return pid_ > 0; }
  /// How it has ended, as the end of a sentence: "was killed by SIGSEGV".
  std::string reap();

 private:
  void receive(void* data, std::size_t size);

  double timeout_;
  Descriptor socket_;
  pid_t pid_ = 0;
};

}  // namespace muro::fmu
