// SPDX-License-Identifier: MIT
#pragma once

namespace muro::host {

/// While an object lives, the first SIGINT (Ctrl-C), SIGTERM or SIGHUP requests a clean end. The second ends the
/// process at once, by that signal, with a line that names the call which did not return. Only one object at a time.
class Interrupt {
 public:
  Interrupt();
  ~Interrupt();
  Interrupt(const Interrupt&) = delete;
  Interrupt& operator=(const Interrupt&) = delete;

  /// Whether the end is requested. [any thread]
  static bool pending();
};

}  // namespace muro::host
