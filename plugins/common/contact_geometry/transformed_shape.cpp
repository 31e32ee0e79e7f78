// SPDX-License-Identifier: MIT
#include "transformed_shape.hpp"
#include "muro/base/bounds.hpp"

#include <limits>

namespace muro::contact_geometry {

Vec3 half_lengths(const Shape& shape) {
  if (shape.kind == ShapeKind::plane) return Vec3::Zero();
  if (shape.kind == ShapeKind::capsule) return {shape.size.x(), shape.size.x(), 0.5 * shape.size.z()};
  return half_extents(shape);
}

TransformedShape transformed(const Shape& shape, const Pose& pose) {
  TransformedShape p;
  p.kind = shape.kind;
  p.half = half_lengths(shape);
  p.centre = pose.position;
  p.axes = pose.orientation.toRotationMatrix();
  return p;
}

Aabb bounds_of(const TransformedShape& shape) {
  if (shape.kind == ShapeKind::plane) {
    const Vec3 half = Vec3::Constant(std::numeric_limits<double>::infinity());
    return {-half, half};
  }
  Vec3 reach = shape.half;
  if (shape.kind != ShapeKind::sphere)
    for (int k = 0; k < 3; ++k) reach[k] = extent_along(shape, shape.axes.row(k));
  return {shape.centre - reach, shape.centre + reach};
}

}  // namespace muro::contact_geometry
