// SPDX-License-Identifier: MIT
#pragma once

#include <set>
#include <string>
#include <string_view>

#include "muro/connector.hpp"

namespace muro::host {

/// Messages of a command on standard error: each line once, even when it runs several simulations.
class Messages {
 public:
  void say(const std::string& line);
  /// Prints a message of an algorithm; a sink for Simulation::set_log.
  void log(LogLevel level, std::string_view text);

 private:
  std::set<std::string> said_;
};

}  // namespace muro::host
