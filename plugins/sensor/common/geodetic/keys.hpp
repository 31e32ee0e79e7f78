// SPDX-License-Identifier: MIT
// Data of receivers of satellite navigation about their world: a constant on the object of the sensor.
#pragma once

#include "muro/geometry.hpp"
#include "muro/key.hpp"

namespace muro::geodetic {

inline constexpr Key<Vec3> key_reference{"gps.reference", "deg, deg, m",
                                         "latitude, longitude and altitude of the world's origin"};

}  // namespace muro::geodetic
