// SPDX-License-Identifier: MIT
#include "placed.hpp"

namespace muro::encounters {

Vec3 half_of(const Shape& shape) {
  if (shape.kind == ShapeKind::plane) return Vec3::Zero();
  if (shape.kind == ShapeKind::capsule) return {shape.size.x(), shape.size.x(), 0.5 * shape.size.z()};
  return half_extents(shape);
}

Placed placed(const Shape& shape, const Pose& pose) {
  Placed p;
  p.kind = shape.kind;
  p.half = half_of(shape);
  p.centre = pose.position;
  p.axes = pose.orientation.toRotationMatrix();
  return p;
}

Aabb bounds_of(const Placed& shape) {
  if (shape.kind == ShapeKind::plane) {
    const Vec3 half = Vec3::Constant(std::numeric_limits<double>::infinity());
    return {-half, half};
  }
  Vec3 reach = shape.half;
  if (shape.kind != ShapeKind::sphere)
    for (int k = 0; k < 3; ++k) reach[k] = reach_along(shape, shape.axes.row(k));
  return {shape.centre - reach, shape.centre + reach};
}

}  // namespace muro::encounters
