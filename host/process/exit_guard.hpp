// SPDX-License-Identifier: MIT
#pragma once

namespace muro::host {

/// While an object lives, no exit(), quick_exit() or, in the program `muro`, _exit() of a library can end the process
/// with success: a line names the caller, and the exit code is 1. It does not see system calls.
class ExitGuard {
 public:
  ExitGuard();
  ~ExitGuard();
  ExitGuard(const ExitGuard&) = delete;
  ExitGuard& operator=(const ExitGuard&) = delete;

  /// Makes the guard run before the exit functions of the libraries that were loaded so far. No effect without a guard.
  static void renew();

  /// Ends the process as _exit() does, also with a guard.
  [[noreturn]] static void leave(int code);
  /// Ends the process for a library, unless there is a guard.
  [[noreturn]] static void leave_for_others(int code);
};

}  // namespace muro::host
