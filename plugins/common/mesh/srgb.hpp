// SPDX-License-Identifier: MIT
#pragma once

#include <cmath>

#include "muro/base/elementary.hpp"

namespace muro::mesh {

/// Converts linear light (0..1) to the sRGB value (0..1): IEC 61966-2-1.
inline double srgb_of(double light) {
  return light <= 0.0031308 ? 12.92 * light : 1.055 * elementary::pow(light, 1 / 2.4) - 0.055;
}

}  // namespace muro::mesh
