// SPDX-License-Identifier: MIT
#pragma once

#include "muro/shape.hpp"

namespace muro::native {

/// A shape at its place, in the form the pair tests read: no quaternion left to unfold.
struct Placed {
  ShapeKind kind = ShapeKind::sphere;
  /// m. box: half lengths. sphere: the radius three times. cylinder, capsule: radius, radius, half the
  /// length along z (of a capsule: of its straight part). plane: unused.
  Vec3 half = Vec3::Zero();
  Vec3 centre = Vec3::Zero();    ///< m, world
  Mat3 axes = Mat3::Identity();  ///< columns: the axes of the shape in the world

  double radius() const { return half.x(); }
  auto axis() const { return axes.col(2); }  ///< of a cylinder or capsule; the normal of a plane
};

/// `shape` with its own frame (not that of its body) at `pose`.
inline Placed placed(const Shape& shape, const Pose& pose) {
  Placed p;
  p.kind = shape.kind;
  p.centre = pose.position;
  p.axes = pose.orientation.toRotationMatrix();
  if (shape.kind == ShapeKind::capsule)
    p.half = {shape.size.x(), shape.size.x(), 0.5 * shape.size.z()};
  else if (shape.kind != ShapeKind::plane)
    p.half = half_extents(shape);
  return p;
}

/// A unit vector at right angles to the unit vector `v`; always the same one for the same `v`.
inline Vec3 perpendicular(const Vec3& v) {
  Vec3::Index least;
  v.cwiseAbs().minCoeff(&least);
  Vec3 other = Vec3::Zero();
  other[least] = 1;
  return v.cross(other).normalized();
}

}  // namespace muro::native
