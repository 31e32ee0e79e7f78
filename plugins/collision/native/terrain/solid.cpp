// SPDX-License-Identifier: MIT
#include "terrain/solid.hpp"

namespace muro::native {

Solid::Solid(const TransformedShape& in_world, const Pose& frame) : shape(in_world) {
  const Mat3 turn = frame.orientation.toRotationMatrix().transpose();
  shape.centre = turn * (in_world.centre - frame.position);
  if (shape.kind != ShapeKind::sphere) shape.axes = turn * in_world.axes;
  if (shape.kind != ShapeKind::mesh) core = ConvexCore::of(shape);
}

Solid::Solid(const TransformedShape& box, const CollisionGeometry& of_hull, const HullSupport& support, const Pose& at,
             const Pose& frame)
    : Solid(box, frame) {
  hull = &of_hull;
  pose = frame.inverse() * at;
  core = ConvexCore::of(support, pose, shape.centre);
}

contact_geometry::Feature Solid::feature_towards(const Vec3& direction) const {
  if (!hull) return contact_geometry::feature_towards(shape, direction);
  return contact_geometry::feature_towards(CollisionObject{hull, pose, shape}, direction, shape.centre, 0);
}

}  // namespace muro::native
