// SPDX-License-Identifier: MIT
// Constants of laser scanners that the vocabulary does not have: on the object of the sensor.
#pragma once

#include "muro/key.hpp"

namespace muro::scanner {

inline constexpr Key<double> key_min_elevation{"laser.min_elevation", "rad", "elevation of the first row"};
inline constexpr Key<double> key_elevation_increment{"laser.elevation_increment", "rad", "from row to row"};

}  // namespace muro::scanner
