// SPDX-License-Identifier: MIT
#pragma once

#include "muro/scene.hpp"

namespace muro::contact_geometry {

/// A shape at a pose in the world, in the form that pair tests read: its axes instead of a quaternion.
struct TransformedShape {
  ShapeKind kind = ShapeKind::sphere;
  /// Half size (m). Box: half lengths. Sphere: the radius three times. Cylinder, capsule: radius, radius, half the
  /// length along z (capsule: of its straight part). Plane: unused. Mesh, heightmap: half lengths of the box around it.
  Vec3 half = Vec3::Zero();
  Vec3 centre = Vec3::Zero();    ///< m, world
  Mat3 axes = Mat3::Identity();  ///< columns: the axes of the shape in the world

  double radius() const { return half.x(); }
  auto axis() const { return axes.col(2); }  ///< of a cylinder or capsule; the normal of a plane
};

/// Returns the values of TransformedShape::half.
Vec3 half_lengths(const Shape& shape);
/// Returns `shape` in the world. `pose`: of its own frame, not of that of its body.
TransformedShape transformed(const Shape& shape, const Pose& pose);
/// Returns the bounds; those of planes are infinite.
Aabb bounds_of(const TransformedShape& shape);

/// Whether the shape is a box, or a mesh or heightmap, for which `half` is that of the box around it.
inline bool is_boxed(const TransformedShape& shape) {
  return shape.kind == ShapeKind::box || shape.kind == ShapeKind::mesh || shape.kind == ShapeKind::heightmap;
}

/// Returns the reach (m) of a box, cylinder or capsule from its centre along a unit vector; a mesh or heightmap counts
/// as the box around it. `c`: products of the unit vector with the shape's axes.
template <class Products>
double extent_along(const TransformedShape& shape, const Products& c) {
  if (is_boxed(shape))
    return std::abs(c[0]) * shape.half.x() + std::abs(c[1]) * shape.half.y() + std::abs(c[2]) * shape.half.z();
  const double along = shape.half.z() * std::abs(c[2]);
  if (shape.kind == ShapeKind::capsule) return along + shape.radius();
  return along + shape.radius() * std::sqrt(c[0] * c[0] + c[1] * c[1]);
}

/// Returns a unit vector at right angles to the unit vector `v`; always the same one for the same `v`.
inline Vec3 perpendicular(const Vec3& v) {
  Vec3::Index least;
  v.cwiseAbs().minCoeff(&least);
  Vec3 other = Vec3::Zero();
  other[least] = 1;
  return v.cross(other).normalized();
}

}  // namespace muro::contact_geometry
