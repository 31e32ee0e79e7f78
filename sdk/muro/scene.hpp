// SPDX-License-Identifier: MIT
// The scene for collision and rays: shapes at their places, and a hierarchy of boxes over them.
#pragma once

#include <limits>

#include "muro/shape.hpp"

namespace muro {

/// Axis-aligned box in world axes, m.
struct Aabb {
  Vec3 low = Vec3::Constant(std::numeric_limits<double>::infinity());
  Vec3 high = Vec3::Constant(-std::numeric_limits<double>::infinity());

  bool overlaps(const Aabb& b) const {
    return (low.array() <= b.high.array()).all() && (b.low.array() <= high.array()).all();
  }
  bool contains(const Aabb& b) const {
    return (low.array() <= b.low.array()).all() && (b.high.array() <= high.array()).all();
  }
  void include(const Aabb& b) {
    low = low.cwiseMin(b.low);
    high = high.cwiseMax(b.high);
  }
};

/// One shape of one body in the scene.
struct Collider {
  const Shape* shape = nullptr;
  const Pose* body_pose = nullptr;  ///< of the body in the world, as it is now
  ObjectId body = no_object;        ///< the object that has the shape
  RobotId robot = no_robot;         ///< no_robot: static scenery
  std::uint32_t shape_index = 0;    ///< among the body's shapes

  /// Pose of the shape in the world.
  Pose pose() const { return *body_pose * shape->origin; }
};

/// A node of a hierarchy of boxes. A leaf has `count` > 0 items, from `first` on in `items`;
/// an inner node's children are `first` and `first + 1`.
struct BvhNode {
  Aabb bounds;
  std::uint32_t first = 0;
  std::uint32_t count = 0;
};

/// A hierarchy; its root is node 0. Empty when there is no node.
struct Bvh {
  std::span<const BvhNode> nodes;
  std::span<const std::uint32_t> items;  ///< items of the leaves, see SceneIndex
};

/// The colliders of one robot: `colliders[first .. first + count)`.
struct RobotColliders {
  std::uint32_t first = 0;
  std::uint32_t count = 0;
  Aabb bounds;    ///< around all of them
  Aabb fat_aabb;  ///< box with a margin in which the robot stays for a while; the same as in `moving`
};

/// The spatial index of the scene: a derived property of the world, valid for the instant in which its writer ran. It
/// has two levels: scenery (built once), and robots (boxes with a margin, refitted only when a robot leaves its box).
/// The few colliders of a robot are tested one by one.
struct SceneIndex {
  std::span<const Collider> colliders;     ///< scenery first, then robot by robot
  std::span<const RobotColliders> robots;  ///< by RobotId
  std::span<const std::uint32_t> planes;   ///< colliders without bounds, tested against everything
  Bvh scenery;                             ///< items are indices of colliders
  Bvh moving;                              ///< items are robot ids
  /// Number of changes of each robot's `fat_aabb`, by RobotId. An array of its own, since every reader asks for changes
  /// and few find any.
  std::span<const std::uint64_t> changes{};
  std::uint64_t all_changes = 0;  ///< their sum
};
MURO_OPAQUE_TYPE(SceneIndex, "muro.SceneIndex", transient);

/// One point in which two bodies touch, from the view of the list's owner (`self`). A contact of two robots is in the
/// lists of both, with equal point and depth and the opposite normal.
struct Contact {
  ObjectId self = no_object;
  ObjectId other = no_object;
  Vec3 point = Vec3::Zero();      ///< m, world: half way between the two surfaces
  Vec3 normal = Vec3::Zero();     ///< unit, world: the direction in which `self` is pushed
  double depth = 0;               ///< m, > 0: overlap of the bodies along the normal
  Surface surface{};              ///< of the pair
  std::uint32_t self_shape = 0;   ///< index among the shapes of `self`
  std::uint32_t other_shape = 0;  ///< index among the shapes of `other`
};
MURO_OPAQUE_TYPE(Contact, "muro.Contact", opaque);

/// One point in which two bodies touch, and the wrench on the first body; the other body gets the opposite. A contact
/// of two robots is in the lists of both, each time with the body of the list's owner first: with equal point and
/// depth, and the opposite normal and wrench. A contact of two bodies of one robot is in its list once.
struct ContactWrench {
  ObjectId body = no_object;
  ObjectId other = no_object;
  Vec3 point = Vec3::Zero();   ///< m, world
  Vec3 normal = Vec3::Zero();  ///< unit, world: the direction in which `body` is pushed
  double depth = 0;            ///< m: overlap of the bodies along the normal; below 0: their distance
  Wrench wrench{};             ///< on `body`, at the point, world axes; not a number: unknown
};
MURO_OPAQUE_TYPE(ContactWrench, "muro.ContactWrench", opaque);

}  // namespace muro
