// SPDX-License-Identifier: MIT
// Shapes of a scene as Bullet collides them.
#pragma once

#include <BulletCollision/CollisionShapes/btCollisionShape.h>

#include <memory>
#include <optional>

#include "bullet_meshes.hpp"
#include "plugins/common/contact_geometry/disc_contact.hpp"
#include "plugins/common/engines/bullet/bullet_types.hpp"
#include "plugins/motion/common/multibody/world.hpp"

namespace muro::bullet {

/// A shape of a robot, a kinematic body or scenery, and where it is at present.
struct Collider {
  std::uint32_t number = 0;  ///< of all colliders of the world: contacts are made in the order of pairs of numbers
  std::int32_t robot = -1;   ///< of this world; -1: an external body
  std::int32_t kinematic_body = -1;
  const std::string* scenery = nullptr;  ///< its name; null for what moves, and for meshes that are shells
  std::uint32_t body = 0;                ///< of the robot
  std::uint32_t loaded_link = 0;         ///< see BodyShape
  std::uint32_t shape_index = 0;         ///< among the shapes of the robot
  ObjectId object = no_object;           ///< that has the shape
  ShapeKind kind = ShapeKind::box;
  Vec3 size = Vec3::Zero();  ///< see Shape
  Surface surface;
  contact_geometry::ShapeExtent extent{};
  Pose pose_in_body;
  terrain_contact::ConvexShape convex;                    ///< of a robot: what touches heightmaps
  Heightmap heightmap;                                    ///< of that kind
  std::shared_ptr<btCollisionShape> shape;                ///< none for a plane or heightmap
  btTransform pose;                                       ///< in the world
  Vec3 aabb_min = Vec3::Zero(), aabb_max = Vec3::Zero();  ///< m: axis-aligned bounding box

  /// Moves it to where its body is, with a box that is larger by `margin` (m).
  void move_to(const Pose& body_pose, double margin);
};

/// Whether it is without bounds below, and stands still.
inline bool is_ground(ShapeKind kind) { return kind == ShapeKind::plane || kind == ShapeKind::heightmap; }

/// A collider for `shape`. `moves`: it belongs to a robot. No shape is made, and the kind is `mesh`, for what Bullet
/// cannot collide: a plane or heightmap that moves.
Collider make_collider(const multibody::BodyShape& shape, const BulletMeshes& meshes, bool moves);

/// The box around a shape of a robot, in the axes of its body; none where it has no bounds.
std::optional<Aabb> box_around(const Shape& shape, const BulletMeshes& meshes);

inline bool overlap(const Vec3& low_a, const Vec3& high_a, const Vec3& low_b, const Vec3& high_b) {
  return (low_a.array() <= high_b.array()).all() && (low_b.array() <= high_a.array()).all();
}

}  // namespace muro::bullet
