// SPDX-License-Identifier: MIT
#pragma once

#include <string>

#include "plugins/common/child_process/child_process.hpp"
#include "protocol.hpp"

namespace muro::parser_process {

/// A parser process, with what it has printed and what it may take.
class Child {
 public:
  /// False, with the reason, when it cannot be started.
  bool start(const std::string& program, std::string& reason);
  /// Whether it was started by this process and not ended since.
  bool is_there() const { return bool(process_); }

  /// False when it has died, or closed its end.
  bool send(const void* data, std::uint64_t size);
  bool receive(void* data, std::uint64_t size);

  /// How it ended.
  struct Death : ChildProcess::End {
    std::string last_words;  ///< the last line that it printed
    Allowance allowed;       ///< for the request, at last
  };
  /// Ends it where it has not ended yet.
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
