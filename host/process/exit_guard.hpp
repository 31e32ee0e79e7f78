// SPDX-License-Identifier: MIT
#pragma once

namespace muro::host {

/// While it lives, the process does not end with success by somebody's exit(), quick_exit() or, in the program `muro`,
/// _exit(): a line says whose, and the exit code is 1. System calls are out of its reach.
class ExitGuard {
 public:
  ExitGuard();
  ~ExitGuard();
  ExitGuard(const ExitGuard&) = delete;
  ExitGuard& operator=(const ExitGuard&) = delete;

  /// Has it look before what libraries that were loaded by now do at an exit. Without effect where there is no guard.
  static void renew();

  /// Ends the process as _exit() does, whoever guards it.
  [[noreturn]] static void leave(int code);
  /// The same for a library, if nobody guards the process.
  [[noreturn]] static void leave_for_others(int code);
};

}  // namespace muro::host
