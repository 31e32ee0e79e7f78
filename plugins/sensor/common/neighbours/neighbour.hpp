// SPDX-License-Identifier: MIT
// The reading of sensor.neighbours, for the sensor and for algorithms that process it.
#pragma once

#include "muro/key.hpp"

namespace muro::neighbours {

/// Another robot as the device of this one sees it, in the frame of the device.
struct Neighbour {
  double id = 0;         ///< number of the robot
  double distance = 0;   ///< m
  double bearing = 0;    ///< rad, -pi .. pi: counter-clockwise about z from x
  double elevation = 0;  ///< rad, -pi/2 .. pi/2: from the xy plane towards z
  double heading = 0;    ///< rad, -pi .. pi: of its x axis, measured like the bearing
};

/// Order of a list: the nearest first; at equal distances the lower number first.
inline bool is_listed_before(const Neighbour& a, const Neighbour& b) {
  return a.distance != b.distance ? a.distance < b.distance : a.id < b.id;
}

inline constexpr std::string_view neighbour_labels[] = {"id", "distance", "bearing", "elevation", "heading"};

inline constexpr std::string_view neighbours_unit = "1, m, rad";

}  // namespace muro::neighbours

namespace muro {
MURO_VALUE_TYPE(neighbours::Neighbour, "muro.Neighbour", f64, neighbours::neighbour_labels);
}  // namespace muro

namespace muro::neighbours {
inline constexpr Key<Neighbour> key_neighbours{"neighbours", neighbours_unit,
                                               "list: the robots that the device sees, the nearest first"};
}  // namespace muro::neighbours
