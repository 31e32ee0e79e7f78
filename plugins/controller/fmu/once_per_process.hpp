// SPDX-License-Identifier: MIT
#pragma once

#include <string>

namespace muro::fmu {

/// The right to the only instance of an FMU in this process. It is returned at the end of this object.
class ProcessClaim {
 public:
  ProcessClaim() = default;
  ~ProcessClaim();
  ProcessClaim(const ProcessClaim&) = delete;
  ProcessClaim& operator=(const ProcessClaim&) = delete;

  /// Returns false when another object has the right. `name`: name of the FMU.
  bool claim(const std::string& name);

 private:
  std::string name_;  ///< empty: no right is held
};

}  // namespace muro::fmu
