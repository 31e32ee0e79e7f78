// SPDX-License-Identifier: MIT
#pragma once

namespace muro::host {

/// While it lives, the first SIGINT (Ctrl-C), SIGTERM or SIGHUP asks for a clean end, and the second ends the process
/// at once, by that signal, with a line that says which call did not return. One at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// Whether the end is asked for. [any thread]
  static bool pending();
};

}  // namespace muro::host
