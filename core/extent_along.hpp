// SPDX-License-Identifier: MIT
#pragma once

#include <span>

#include "muro/toolkit/support.hpp"

namespace muro {

/// Returns how far (m) a shape at `pose` extends along `direction` (unit) from the origin of the frame of both; 0 or
/// less when it lies on the other side completely. `corners`: corners of the convex hull of a mesh, not scaled; a mesh
/// without corners counts as a point.
inline double extent_along(const Shape& shape, std::span<const Vec3> corners, const Pose& pose, const Vec3& direction) {
  const double middle = direction.dot(pose.position);
  const Vec3 in_shape = pose.orientation.conjugate() * direction;
  if (shape.kind != ShapeKind::mesh || corners.empty()) return middle + support(shape, in_shape);
  const Vec3 scaled = shape.size.cwiseProduct(in_shape);
  double most = -std::numeric_limits<double>::infinity();
  for (const Vec3& corner : corners) most = std::max(most, scaled.dot(corner));
  return middle + most;
}

}  // namespace muro
