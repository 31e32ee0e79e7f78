// SPDX-License-Identifier: MIT
// Properties of laser scanners.
#pragma once

#include "muro/key.hpp"
#include "muro/object.hpp"

namespace muro::keys {

// Laser scanners: properties of the sensor's object. Angles are counter-clockwise about z, 0 along x.
inline constexpr Key<double> laser_min_angle{"laser.min_angle", "rad", "direction of the first ray of a row"};
inline constexpr Key<double> laser_angle_increment{"laser.angle_increment", "rad",
                                                   "between neighbouring rays of a row"};
inline constexpr Key<double> laser_min_elevation{"laser.min_elevation", "rad", "elevation of the first row"};
inline constexpr Key<double> laser_elevation_increment{"laser.elevation_increment", "rad", "from row to row"};
inline constexpr Key<std::uint32_t> laser_columns{"laser.columns", "1", "rays in a row"};
inline constexpr Key<std::uint32_t> laser_rows{"laser.rows", "1", "rows; rays are stored row by row from below"};
inline constexpr Key<double> laser_min_range{"laser.min_range", "m", "nothing nearer is seen"};
inline constexpr Key<double> laser_max_range{"laser.max_range", "m", "nothing farther is seen; such a ray reads this"};
inline constexpr Key<double> ranges{"ranges", "m", "array: true distance along each ray"};
inline constexpr Key<double> measured_ranges{"ranges.measured", "m", "array: the distance as the device reports it"};
inline constexpr Key<ObjectId> laser_hits{"laser.hits", "1", "array: the object each ray hits, or none"};
inline constexpr Key<double> laser_incidence{"laser.incidence", "rad",
                                             "array: between each ray and the normal of the surface it hits"};

}  // namespace muro::keys
