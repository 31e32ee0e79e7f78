// SPDX-License-Identifier: MIT
#pragma once

namespace muro::host {

/// While it lives, the process does not end with success by somebody's exit() or quick_exit(): a line says whose, and
/// the exit code is 1. _exit() is out of its reach.
class ExitGuard {
 public:
  ExitGuard();
  ~ExitGuard();
  ExitGuard(const ExitGuard&) = delete;
  ExitGuard& operator=(const ExitGuard&) = delete;

  /// Has it look before what libraries that were loaded by now do at an exit. Without effect where there is no guard.
  static void renew();
};

}  // namespace muro::host
