// SPDX-License-Identifier: MIT
#include "collider.hpp"

#include <BulletCollision/CollisionShapes/btBoxShape.h>
#include <BulletCollision/CollisionShapes/btCapsuleShape.h>
#include <BulletCollision/CollisionShapes/btCylinderShape.h>
#include <BulletCollision/CollisionShapes/btSphereShape.h>

#include "meshes.hpp"

namespace muro::bullet {

namespace {

/// Bullet shrinks a box or cylinder by its margin and rounds what is left by the same: faces stay where they are,
/// edges get this radius.
double margin_of(const Vec3& half) { return std::min(1e-3, 0.1 * half.minCoeff()); }

std::shared_ptr<btCollisionShape> make_shape(const Shape& s, const Meshes& meshes, bool moves) {
  const Vec3 half = half_extents(s);
  switch (s.kind) {
    case ShapeKind::box: {
      auto box = std::make_shared<btBoxShape>(bullet(half));
      box->setMargin(margin_of(half));
      box->initializePolyhedralFeatures();
      return box;
    }
    case ShapeKind::sphere:
      return std::make_shared<btSphereShape>(s.size.x());
    case ShapeKind::cylinder: {
      auto cylinder = std::make_shared<btCylinderShapeZ>(bullet(half));
      cylinder->setMargin(margin_of(half));
      return cylinder;
    }
    case ShapeKind::capsule:
      return std::make_shared<btCapsuleShapeZ>(s.size.x(), s.size.z());
    case ShapeKind::mesh:
      return moves ? meshes.hull(s) : meshes.scenery(s);
    case ShapeKind::plane:
      break;
  }
  return nullptr;
}

}  // namespace

Collider make_collider(const multibody::PartShape& shape, const Meshes& meshes, bool moves) {
  Collider c;
  c.kind = shape.shape.kind;
  if (c.kind == ShapeKind::plane && moves) c.kind = ShapeKind::mesh;
  c.size = shape.shape.size;
  c.friction = shape.shape.friction;
  c.restitution = shape.shape.restitution;
  c.body = shape.body;
  c.in_part = shape.shape.origin;
  c.shape = make_shape(shape.shape, meshes, moves);
  return c;
}

void Collider::move_to(const Pose& part_pose, double margin) {
  pose = bullet(part_pose * in_part);
  if (!shape) return;
  btVector3 least, most;
  shape->getAabb(pose, least, most);
  low = muro_of(least).array() - margin;
  high = muro_of(most).array() + margin;
}

}  // namespace muro::bullet
