// SPDX-License-Identifier: MIT
// Kernels: the bounding boxes of robots of identical structure.
#pragma once

#include "muro/simd/isa.hpp"
#include "plugins/common/contact_geometry/pose_location.hpp"

namespace muro::bvh {

using contact_geometry::PoseLocation, contact_geometry::RobotPoses;

/// Bounds of some shapes of a robot: the points within `ball` of a box in a body, along the body's axes.
struct RoundedBox {
  PoseLocation pose;      ///< of the body
  double centre[3] = {};  ///< m
  double half[3] = {};    ///< m
  double ball = 0;        ///< m

  friend bool operator==(const RoundedBox&, const RoundedBox&) = default;
};

/// The input and output of one call: at most eight robots.
struct BoundsBatch {
  const RoundedBox* boxes = nullptr;  ///< of each robot, one a body; at least one
  int box_count = 0;
  int used = 0;  ///< robots
  RobotPoses poses[8];
  double* bounds[8];  ///< of each robot: low and high of its AABB, which is written, then of its fat AABB
};

struct BoundsKernels {
  /// Returns a bit for each robot that is not within its fat AABB.
  unsigned (*update)(const BoundsBatch&);
};
MURO_DECLARE_KERNELS(BoundsKernels, bounds_kernels)

}  // namespace muro::bvh
