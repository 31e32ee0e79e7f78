// SPDX-License-Identifier: MIT
// Pose of a device on the frame that carries it: for sensors.
#pragma once

#include "muro/algorithm.hpp"
#include "muro/toolkit/rotations.hpp"
#include "muro/vocabulary.hpp"

namespace muro {

inline constexpr double no_mounting[] = {0, 0, 0};
inline constexpr Parameter mounting_offset =
    reals("offset", "m", no_mounting, "position x, y, z of the device in the frame it is mounted on").of_length(3);
inline constexpr Parameter mounting_rpy =
    reals("rpy", "rad", no_mounting, "roll, pitch, yaw of the device in the frame it is mounted on").of_length(3);
inline constexpr PropertyUse mounting_writes{"sensor.origin", "constant: offset and rpy"};

/// Returns the pose of the device in the frame it is mounted on, from both parameters. [setup]
inline Pose mounting_of(const Parameters& p) {
  const std::span<const double> at = p.reals(mounting_offset.name), rpy = p.reals(mounting_rpy.name);
  return {{at[0], at[1], at[2]}, from_rpy(rpy[0], rpy[1], rpy[2])};
}

}  // namespace muro
