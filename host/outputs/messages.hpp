// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "muro/connector.hpp"

namespace muro::host {

/// What a command says on standard error: each line once, however many simulations it runs.
class Messages {
 public:
  void say(const std::string& line);
  /// A message of an algorithm: a sink for Simulation::set_log.
  void log(LogLevel level, std::string_view text);

 private:
  std::set<std::string> said_;
};

}  // namespace muro::host
