// SPDX-License-Identifier: MIT
#pragma once

#include <algorithm>
#include <cmath>
#include <limits>

#include "per_component.hpp"

namespace muro {

/// Converts an analogue value to the number that a device reports: saturation, resolution of the converter, limits.
///
/// 1. Saturation: the value is clipped to [-full_scale, full_scale], exactly.
/// 2. Resolution: it becomes the nearest multiple of the step. A converter of n `bits` has the step
///    2 full_scale / 2^n and the codes -2^(n-1) .. 2^(n-1) - 1 of two's complement.
/// 3. The reading is limited to [minimum, maximum].
struct Quantiser {
  double full_scale = std::numeric_limits<double>::infinity();
  int bits = 0;               ///< 0: no converter
  PerComponent resolution{};  ///< step if there is no converter; 0: none
  double minimum = -std::numeric_limits<double>::infinity();
  double maximum = std::numeric_limits<double>::infinity();

  /// Returns the least difference of two readings; 0: none.
  PerComponent step() const { return bits > 0 ? std::ldexp(full_scale, 1 - bits) : resolution; }

  double operator()(double y, std::size_t component = 0) const {
    y = std::min(std::max(y, -full_scale), full_scale);
    if (bits > 0) {
      const double half = std::ldexp(1.0, bits - 1), lsb = full_scale / half;
      y = lsb * std::min(std::max(std::round(y / lsb), -half), half - 1);
    } else if (const double step = resolution[component]; step > 0) {
      y = step * std::round(y / step);
    }
    return std::min(std::max(y, minimum), maximum);
  }
};

}  // namespace muro
