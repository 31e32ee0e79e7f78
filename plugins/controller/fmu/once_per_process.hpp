// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace muro::fmu {

/// The right to the only instance of an FMU in this process, given back at its end.
class ProcessClaim {
 public:
  ProcessClaim() = default;
  ~ProcessClaim();
  ProcessClaim(const ProcessClaim&) = delete;
  ProcessClaim& operator=(const ProcessClaim&) = delete;

  /// False when somebody else has it. `name` is that of the FMU.
  bool claim(const std::string& name);

 private:
  std::string name_;  ///< empty: none is held
};

}  // namespace muro::fmu
