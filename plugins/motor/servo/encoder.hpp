// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

namespace muro::servo {

/// An encoder with a finite number of steps. It measures speed by differences of its readings.
struct Encoder {
  double resolution = 0;  ///< rad or m a step; 0: exact
  double filter = 0;      ///< s, time constant of the speed; 0: none
  double offset = 0;      ///< rad or m: true position minus measured position

  /// Returns the measured position at the true one.
  double reading(double position) const {
    const double measured = position - offset;
    return resolution > 0 ? std::round(measured / resolution) * resolution : measured;
  }
  /// Returns the measured speed. `now`, `last`: readings of this run and of the last one; `speed`: the speed measured
  /// in the last run; `exact`: the true speed.
  double measured_speed(double now, double last, double speed, double exact, double dt) const {
    const double raw = resolution > 0 ? (now - last) / dt : exact;
    return speed + (raw - speed) * (dt / (filter + dt));
  }
};

}  // namespace muro::servo
