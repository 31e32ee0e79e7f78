// SPDX-License-Identifier: MIT
// Collision shapes of a scene in Bullet.
#pragma once

#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include <memory>
#include <optional>

#include "bullet_meshes.hpp"
#include "plugins/common/contact_geometry/disc_contact.hpp"
#include "plugins/common/engines/bullet/bullet_types.hpp"
#include "plugins/motion/common/multibody/world.hpp"

namespace muro::bullet {

/// A shape of a robot, a kinematic body or scenery, and its present pose.
struct Collider {
  std::uint32_t number = 0;  ///< among all colliders of the world: contacts are made in the order of pairs of numbers
  std::int32_t robot = -1;   ///< robot of this world; -1: an external body
  std::int32_t kinematic_body = -1;
  const std::string* scenery = nullptr;  ///< its name; null for moving bodies, and for meshes that are shells
  std::uint32_t body = 0;                ///< body of the robot
  std::uint32_t loaded_link = 0;         ///< see BodyShape
  std::uint32_t shape_index = 0;         ///< among the shapes of the robot
  ObjectId object = no_object;           ///< object that has the shape
  ShapeKind kind = ShapeKind::box;
  Vec3 size = Vec3::Zero();  ///< see Shape
  Surface surface;
  contact_geometry::ShapeExtent extent{};
  Pose pose_in_body;
  terrain_contact::ConvexShape convex;                    ///< for a robot: shape that touches heightmaps
  Heightmap heightmap;                                    ///< for the kind heightmap
  std::shared_ptr<btCollisionShape> shape;                ///< none for a plane or heightmap
  btTransform pose;                                       ///< in the world
  Vec3 aabb_min = Vec3::Zero(), aabb_max = Vec3::Zero();  ///< m: axis-aligned bounding box

  /// Moves it to the pose of its body, with a bounding box enlarged by `margin` (m).
  void move_to(const Pose& body_pose, double margin);
};

/// Whether shapes of this kind are unbounded below and stand still.
inline bool is_ground(ShapeKind kind) { return kind == ShapeKind::plane || kind == ShapeKind::heightmap; }

/// Makes a collider for `shape`. `moves`: whether it belongs to a robot. Bullet cannot collide a plane or heightmap
/// that moves: such a collider has no shape, and its kind is `mesh`.
Collider make_collider(const multibody::BodyShape& shape, const BulletMeshes& meshes, bool moves);

/// Returns the box around a shape of a robot, in the axes of its body; nothing for a shape without bounds.
std::optional<Aabb> box_around(const Shape& shape, const BulletMeshes& meshes);

inline bool overlap(const Vec3& low_a, const Vec3& high_a, const Vec3& low_b, const Vec3& high_b) {
  return (low_a.array() <= high_b.array()).all() && (low_b.array() <= high_a.array()).all();
}

}  // namespace muro::bullet
