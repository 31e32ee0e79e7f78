// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>

#include "muro/simd/lane.hpp"

namespace muro::contact_geometry {

/// Where the poses of a robot's bodies lie in memory. Those of bases lie in one array and those of links in another, in
/// each mostly in equal distances from robot to robot.
struct RobotPoses {
  const double* base = nullptr;
  const double* links = nullptr;  ///< of one of the links
};

/// Where the pose of one body lies, the same for all robots of a group.
struct PoseLocation {
  bool of_base = true;
  std::ptrdiff_t offset = 0;  ///< numbers, of a link's pose from RobotPoses::links

  MURO_INLINE const double* in(const RobotPoses& poses) const { return of_base ? poses.base : poses.links + offset; }
  friend bool operator==(const PoseLocation&, const PoseLocation&) = default;
};

}  // namespace muro::contact_geometry
