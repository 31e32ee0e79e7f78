// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>

namespace muro::scip2 {

/// States of a device while `DB` simulates a fault.
enum class Health : std::uint8_t {
  normal,
  checking,  ///< it stops to check the fault: scans have status 21 and no data
  resuming,  ///< the first good scan has status 98 and no data
  failed,    ///< it needs a reset: status 50, BM 01
};

/// Number of mirror turns for each stage of a simulated fault.
inline constexpr std::uint32_t fault_stage_scans = 10;

/// Returns the health for a code of `DB`. 01: malfunction, then normal. 02: failure. 03: normal, malfunction, normal.
/// 04: normal, malfunction, failure. 05: normal, failure. 00 and 10: normal. `scans`: turns since the command.
constexpr Health health_of(std::uint8_t fault, std::uint32_t scans) {
  const std::uint32_t stage = scans / fault_stage_scans;
  const auto resumed = [&](std::uint32_t at) {
    return scans == at * fault_stage_scans ? Health::resuming : Health::normal;
  };
  switch (fault) {
    case 1:
      return stage == 0 ? Health::checking : resumed(1);
    case 2:
      return Health::failed;
    case 3:
      return stage == 0 ? Health::normal : stage == 1 ? Health::checking : resumed(2);
    case 4:
      return stage == 0 ? Health::normal : stage == 1 ? Health::checking : Health::failed;
    case 5:
      return stage == 0 ? Health::normal : Health::failed;
    default:
      return Health::normal;
  }
}

/// Whether the stages are over, so that the device is normal until the next `DB`.
constexpr bool has_ended(std::uint8_t fault, std::uint32_t scans) {
  const std::uint32_t stages = fault == 1 ? 1 : 2;
  return fault == 0 || ((fault == 1 || fault == 3) && scans > stages * fault_stage_scans);
}

}  // namespace muro::scip2
