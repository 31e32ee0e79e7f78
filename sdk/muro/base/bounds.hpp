// SPDX-License-Identifier: MIT
// Boxes around shapes.
#pragma once

#include "muro/scene.hpp"

namespace muro {

/// Half lengths (m) of the smallest box around a shape, in the axes of the shape. Infinite for a plane; zero for a
/// mesh, and in z for a heightmap (only the reader of the file knows its extent).
inline Vec3 half_extents(const Shape& s) {
  switch (s.kind) {
    case ShapeKind::box:
      return 0.5 * s.size;
    case ShapeKind::sphere:
      return Vec3::Constant(s.size.x());
    case ShapeKind::cylinder:
      return {s.size.x(), s.size.x(), 0.5 * s.size.z()};
    case ShapeKind::capsule:
      return {s.size.x(), s.size.x(), s.size.x() + 0.5 * s.size.z()};
    case ShapeKind::plane:
      return Vec3::Constant(std::numeric_limits<double>::infinity());
    case ShapeKind::mesh:
      break;
    case ShapeKind::heightmap:
      return {0.5 * s.size.x(), 0.5 * s.size.y(), 0};
  }
  return Vec3::Zero();
}

/// Returns the box around `shape` when the shape (not its body) is at `pose`. Planes are infinite.
inline Aabb bounds_of(const Shape& shape, const Pose& pose) {
  const Vec3 half = half_extents(shape);
  if (shape.kind == ShapeKind::plane) return {-half, half};
  if (shape.kind == ShapeKind::sphere) return {pose.position - half, pose.position + half};
  const Vec3 reach = pose.orientation.toRotationMatrix().cwiseAbs() * half;
  return {pose.position - reach, pose.position + reach};
}

/// Returns the box around the shape of a collider, in the world.
inline Aabb bounds_of(const Collider& collider) { return bounds_of(*collider.shape, collider.pose()); }

}  // namespace muro
