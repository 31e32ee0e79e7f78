// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "plugins/common/child_process/child_process.hpp"
#include "protocol.hpp"

namespace muro::parser_process {

/// A parser process, with what it has printed and its allowance.
class Child {
 public:
  /// Starts the process. Returns false, with the reason, if it cannot be started.
  bool start(const std::string& program, std::string& reason);
  /// Whether this process has started it and not ended it since.
  bool is_there() const { return bool(process_); }

  /// Transfers bytes. Returns false if the process has died, or closed its end.
  bool send(const void* data, std::uint64_t size);
  bool receive(void* data, std::uint64_t size);

  /// The way in which it ended.
  struct Death : ChildProcess::End {
    std::string last_words;  ///< the last line that it printed
    Allowance allowed;       ///< last allowance of the request
  };
  /// Ends the process if it has not ended yet.
  Death end();
  /// Forgets what it has printed so far.
  void clear_output();

 private:
  std::string last_line() const;
  Allowance allowance() const;

  ChildProcess process_;
  Descriptor output_, allowance_;
};

}  // namespace muro::parser_process
