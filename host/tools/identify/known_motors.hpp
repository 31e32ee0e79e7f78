// SPDX-License-Identifier: MIT
// What the firmware of some servos does with its P gain.
#pragma once

#include <string_view>

namespace muro::host {

struct KnownMotor {
  std::string_view name;  ///< as records call it, or its beginning
  double duty_gain;       ///< 1/rad: duty by error of position, for each unit of the P gain
  double duty_limit;
  double full_load;  ///< what a record's `load` is at full duty; 0: it is no duty
};

/// By oscilloscope: MX, XL-320, STS3215 (Rhoban/bam). XL-330: 4096 / (2 pi) / (256 * 885), as its recorded duties say.
inline constexpr KnownMotor known_motors[] = {{"mx", 0.158, 0.9625, 0},        {"xl320", 0.05048199, 1, 0},
                                              {"xl330", 0.0028773775, 1, 885}, {"xc330", 0.0028773775, 1, 885},
                                              {"sts3215", 0.166, 0.97, 0},     {"feetech_sts3215", 0.166, 0.97, 0}};

/// Null where nothing is known of it.
inline const KnownMotor* known_motor(std::string_view name) {
  for (const KnownMotor& m : known_motors)
    if (name.substr(0, m.name.size()) == m.name) return &m;
  return nullptr;
}

}  // namespace muro::host
