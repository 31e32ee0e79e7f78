// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <string>

#include "plugins/common/shared_call/descriptor.hpp"
#include "protocol.hpp"

namespace muro::parser_process {

/// A running program with a socket to it.
class Child {
 public:
  Child() = default;
  ~Child() { abandon(); }
  Child(const Child&) = delete;
  Child& operator=(const Child&) = delete;

  /// False, with the reason, when it cannot be started.
  bool start(const std::string& program, std::string& reason);
  /// Whether it was started by this process and not ended since.
  bool is_there() const;

  /// False when it has died, or closed its end.
  bool send(const void* data, std::uint64_t size);
  bool receive(void* data, std::uint64_t size);

  /// How it ended.
  struct Death {
    int signal = 0;          ///< 0: it has ended by itself
    int code = 0;            ///< -1: unknown
    std::string last_words;  ///< the last line that it printed
    Allowance allowed;       ///< for the request, at last
  };
  /// Ends it where it has not ended yet.
  Death end();
  /// Forgets what it has printed so far.
  void clear_output();

 private:
  void abandon();
  std::string last_line() const;
  Allowance allowance() const;

  Descriptor socket_, process_, output_, allowance_;
  int owner_ = 0;  ///< the process that started it; another one has copies of the descriptors after a fork
};

}  // namespace muro::parser_process
