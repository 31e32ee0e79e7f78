// SPDX-License-Identifier: MIT
#pragma once

#include <fmt/format.h>
#include <unistd.h>

#include <cstdio>
#include <string>

namespace muro::host {

/// Shows the variation that runs, on one line of the terminal.
class CurrentRun {
 public:
  void show(const std::string& label) const {
    if (shown_) fmt::print(stderr, "\r\033[K{} ...", label), std::fflush(stderr);
  }
  void close() const {
    if (shown_) fmt::print(stderr, "\r\033[K");
  }

 private:
  bool shown_ = isatty(STDERR_FILENO) != 0;
};

}  // namespace muro::host
