// SPDX-License-Identifier: MIT
// Effects of the P gain in the firmware of some servos.
#pragma once

#include <string_view>

namespace muro::host {

struct KnownMotor {
  std::string_view name;  ///< name in records, or its beginning
  double duty_gain;       ///< 1/rad: duty by error of position, for each unit of the P gain
  double duty_limit;
  double full_load;  ///< value of a record's `load` at full duty; 0: `load` is no duty
};

/// Oscilloscope values: MX, XL-320, STS3215 (Rhoban/bam). XL-330: 4096 / (2 pi) / (256 * 885), from recorded duties.
inline constexpr KnownMotor known_motors[] = {{"mx", 0.158, 0.9625, 0},        {"xl320", 0.05048199, 1, 0},
                                              {"xl330", 0.0028773775, 1, 885}, {"xc330", 0.0028773775, 1, 885},
                                              {"sts3215", 0.166, 0.97, 0},     {"feetech_sts3215", 0.166, 0.97, 0}};

/// Returns the data of a motor; null when it is unknown.
inline const KnownMotor* known_motor(std::string_view name) {
  for (const KnownMotor& m : known_motors)
    if (name.substr(0, m.name.size()) == m.name) return &m;
  return nullptr;
}

}  // namespace muro::host
