// SPDX-License-Identifier: MIT
// What receivers of satellite navigation say of their world: a constant on the object of the sensor.
#pragma once

#include "muro/geometry.hpp"
#include "muro/key.hpp"

namespace muro::geodetic {

inline constexpr Key<Vec3> key_reference{"gps.reference", "deg, deg, m",
                                         "latitude, longitude and altitude of the world's origin"};

}  // namespace muro::geodetic
