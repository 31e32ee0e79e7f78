// SPDX-License-Identifier: MIT
// Kernels for the bounding boxes of robots of identical structure.
#pragma once

#include "muro/simd/isa.hpp"
#include "plugins/common/contact_geometry/pose_location.hpp"

namespace muro::bvh {

using contact_geometry::PoseLocation, contact_geometry::RobotPoses;

/// Bounds of some shapes of a robot: the points within the distance `ball` of a box along the axes of a body.
struct RoundedBox {
  PoseLocation pose;      ///< pose of the body
  double centre[3] = {};  ///< m
  double half[3] = {};    ///< m
  double ball = 0;        ///< m

  friend bool operator==(const RoundedBox&, const RoundedBox&) = default;
};

/// Input and output of one call for at most eight robots.
struct BoundsBatch {
  const RoundedBox* boxes = nullptr;  ///< boxes of each robot, one for each body; at least one
  int box_count = 0;
  int used = 0;  ///< number of robots
  RobotPoses poses[8];
  double* bounds[8];  ///< by robot: low and high of its AABB, which is written, then those of its fat AABB
};

struct BoundsKernels {
  /// Returns a bit for each robot that is not within its fat AABB.
  unsigned (*update)(const BoundsBatch&);
};
MURO_DECLARE_KERNELS(BoundsKernels, bounds_kernels)

}  // namespace muro::bvh
