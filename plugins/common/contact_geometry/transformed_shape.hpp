// SPDX-License-Identifier: MIT
#pragma once

#include "muro/scene.hpp"

namespace muro::contact_geometry {

/// A shape at a pose in the world, in the form that pair tests read: its axes instead of a quaternion.
struct TransformedShape {
  ShapeKind kind = ShapeKind::sphere;
  /// m. box: half lengths. sphere: the radius three times. cylinder, capsule: radius, radius, half the
  /// length along z (of a capsule: of its straight part). plane: unused. mesh, heightmap: of the box around it.
  Vec3 half = Vec3::Zero();
  Vec3 centre = Vec3::Zero();    ///< m, world
  Mat3 axes = Mat3::Identity();  ///< columns: the axes of the shape in the world

  double radius() const { return half.x(); }
  auto axis() const { return axes.col(2); }  ///< of a cylinder or capsule; the normal of a plane
};

/// As in TransformedShape::half.
Vec3 half_lengths(const Shape& shape);
/// `shape` with its own frame (not that of its body) at `pose`.
TransformedShape transformed(const Shape& shape, const Pose& pose);
/// Planes are infinite.
Aabb bounds_of(const TransformedShape& shape);

/// Whether the shape is a box, or a mesh or heightmap, of which `half` is that of the box around it.
inline bool is_boxed(const TransformedShape& shape) {
  return shape.kind == ShapeKind::box || shape.kind == ShapeKind::mesh || shape.kind == ShapeKind::heightmap;
}

/// How far (m) a box (of a mesh or heightmap: the one around it), cylinder or capsule reaches from its centre along a
/// unit vector, which is given by its products with the shape's axes.
template <class Products>
double extent_along(const TransformedShape& shape, const Products& c) {
  if (is_boxed(shape))
    return std::abs(c[0]) * shape.half.x() + std::abs(c[1]) * shape.half.y() + std::abs(c[2]) * shape.half.z();
  const double along = shape.half.z() * std::abs(c[2]);
  if (shape.kind == ShapeKind::capsule) return along + shape.radius();
  return along + shape.radius() * std::sqrt(c[0] * c[0] + c[1] * c[1]);
}

/// A unit vector at right angles to the unit vector `v`; always the same one for the same `v`.
inline Vec3 perpendicular(const Vec3& v) {
  Vec3::Index least;
  v.cwiseAbs().minCoeff(&least);
  Vec3 other = Vec3::Zero();
  other[least] = 1;
  return v.cross(other).normalized();
}

}  // namespace muro::contact_geometry
