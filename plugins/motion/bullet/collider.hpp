// SPDX-License-Identifier: MIT
// Shapes of a scene as Bullet collides them.
#pragma once

#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include <memory>

#include "convert.hpp"
#include "plugins/common/multibody/world.hpp"

namespace muro::bullet {

class Meshes;

/// A shape of a part, an obstacle or scenery, and where it is at present.
struct Collider {
  std::uint32_t number = 0;  ///< of all colliders of the world: contacts are made in the order of pairs of numbers
  std::int32_t robot = -1;   ///< of this world; -1: a fixture
  std::int32_t obstacle = -1;
  std::uint32_t part = 0;
  std::uint32_t body = 0;   ///< of the model, see PartShape
  std::uint32_t place = 0;  ///< among the shapes of the robot
  ShapeKind kind = ShapeKind::box;
  Vec3 size = Vec3::Zero();  ///< see Shape
  double friction = 0, restitution = 0;
  Pose in_part;
  std::shared_ptr<btCollisionShape> shape;       ///< none for a plane
  btTransform pose;                              ///< in the world
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  ///< m: box around it

  /// Places it where its part is, with a box that is larger by `margin` (m).
  void move_to(const Pose& part_pose, double margin);
};

/// A collider for `shape`. `moves`: it belongs to a robot. No shape is made, and the kind is `mesh`, for what Bullet
/// cannot collide: a plane that moves.
Collider make_collider(const multibody::PartShape& shape, const Meshes& meshes, bool moves);

inline bool overlap(const Vec3& low_a, const Vec3& high_a, const Vec3& low_b, const Vec3& high_b) {
  return (low_a.array() <= high_b.array()).all() && (low_b.array() <= high_a.array()).all();
}

}  // namespace muro::bullet
