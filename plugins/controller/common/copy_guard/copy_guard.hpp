// SPDX-License-Identifier: MIT
#pragma once

namespace muro {

/// Guards a call of loaded code, such as control code or an FMU. When that code calls fork(), the call also returns in
/// a copy of the whole process. The copy would hold a second simulator, or a second end of a call from a simulator.
class CopyGuard {
 public:
  CopyGuard();
  ~CopyGuard();
  CopyGuard(const CopyGuard&) = delete;
  CopyGuard& operator=(const CopyGuard&) = delete;

  /// Ends the process if it is a copy, with a line to standard error. `function`: name of the call that has returned.
  static void end_copy(const char* function);
};

}  // namespace muro
