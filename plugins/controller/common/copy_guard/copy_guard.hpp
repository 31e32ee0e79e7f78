// SPDX-License-Identifier: MIT
#pragma once

namespace muro {

/// Stands around a call of code that was loaded: control code, an FMU. When that calls fork(), a copy of the whole
/// process comes back from the call, too: with a simulator, or its end of a call from one, that is there once already.
class CopyGuard {
 public:
  CopyGuard();
  ~CopyGuard();
  CopyGuard(const CopyGuard&) = delete;
  CopyGuard& operator=(const CopyGuard&) = delete;

  /// In a copy: writes a line to standard error, and ends it. `function`: which has come back.
  static void end_copy(const char* function);
};

}  // namespace muro
