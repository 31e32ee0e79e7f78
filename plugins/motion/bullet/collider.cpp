// SPDX-License-Identifier: MIT
#include "collider.hpp"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>

#include "muro/base/bounds.hpp"

namespace muro::bullet {

namespace {

/// Returns the margin of a box or cylinder. Bullet shrinks the shape by the margin and rounds it by the same: faces
/// keep their place, edges get this radius.
double margin_of(const Vec3& half) { return std::min(1e-3, 0.1 * half.minCoeff()); }

std::shared_ptr<btCollisionShape> make_shape(const Shape& s, const BulletMeshes& meshes, bool moves) {
  const Vec3 half = half_extents(s);
  switch (s.kind) {
    case ShapeKind::box: {
      auto box = std::make_shared<btBoxShape>(to_bullet(half));
      box->setMargin(margin_of(half));
      box->initializePolyhedralFeatures();
      return box;
    }
    case ShapeKind::sphere:
      return std::make_shared<btSphereShape>(s.size.x());
    case ShapeKind::cylinder: {
      auto cylinder = std::make_shared<btCylinderShapeZ>(to_bullet(half));
      cylinder->setMargin(margin_of(half));
      return cylinder;
    }
    case ShapeKind::capsule:
      return std::make_shared<btCapsuleShapeZ>(s.size.x(), s.size.z());
    case ShapeKind::mesh:
      return meshes.of(s, moves);
    case ShapeKind::plane:
    case ShapeKind::heightmap:
      break;
  }
  return nullptr;
}

}  // namespace

Collider make_collider(const multibody::BodyShape& shape, const BulletMeshes& meshes, bool moves) {
  Collider c;
  c.kind = shape.shape.kind;
  if (is_ground(c.kind) && moves) c.kind = ShapeKind::mesh;
  c.size = shape.shape.size;
  c.surface = shape.shape.surface;
  c.extent = contact_geometry::extent_of(shape.shape);
  c.loaded_link = shape.loaded_link;
  c.object = shape.object;
  c.pose_in_body = shape.shape.origin;
  c.shape = make_shape(shape.shape, meshes, moves);
  if (moves) c.convex = meshes.convex_shape(shape.shape);
  if (c.kind == ShapeKind::heightmap) c.heightmap = meshes.heightmap(shape.shape);
  return c;
}

std::optional<Aabb> box_around(const Shape& shape, const BulletMeshes& meshes) {
  if (is_ground(shape.kind)) return {};
  if (shape.kind != ShapeKind::mesh) return bounds_of(shape, shape.origin);
  btVector3 low, high;
  meshes.of(shape, true)->getAabb(to_bullet(shape.origin), low, high);
  return Aabb{from_bullet(low), from_bullet(high)};
}

void Collider::move_to(const Pose& body_pose, double margin) {
  pose = to_bullet(body_pose * pose_in_body);
  if (!shape) return;
  btVector3 min, max;
  shape->getAabb(pose, min, max);
  aabb_min = from_bullet(min).array() - margin;
  aabb_max = from_bullet(max).array() + margin;
}

}  // namespace muro::bullet
