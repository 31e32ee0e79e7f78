// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "muro/simd/lane.hpp"

namespace muro::contact_geometry {

/// Location of the poses of a robot's bodies in memory. Poses of bases are in one array and poses of links in another,
/// usually at equal distances from robot to robot.
struct RobotPoses {
  const double* base = nullptr;
  const double* links = nullptr;  ///< of one of the links
};

/// Location of the pose of one body, the same for all robots of a group.
struct PoseLocation {
  bool of_base = true;
  std::ptrdiff_t offset = 0;  ///< numbers, of a link's pose from RobotPoses::links

  MURO_INLINE const double* in(const RobotPoses& poses) const { return of_base ? poses.base : poses.links + offset; }
  friend bool operator==(const PoseLocation&, const PoseLocation&) = default;
};

}  // namespace muro::contact_geometry
