// SPDX-License-Identifier: MIT
#include "scene_table.hpp"
#include "muro/base/bounds.hpp"
#include "plugins/common/heightmap/solid.hpp"

namespace muro::raycast {

namespace {

PrimitiveKind kind_of(const Shape& shape, const Quat& turn) {
  switch (shape.kind) {
    case ShapeKind::sphere:
      return PrimitiveKind::sphere;
    case ShapeKind::cylinder:
      return PrimitiveKind::cylinder;
    case ShapeKind::capsule:
      return PrimitiveKind::capsule;
    default:
      return turn.vec().isZero(0) ? PrimitiveKind::aligned_box : PrimitiveKind::box;
  }
}

/// Returns the shape at `pose`, in the world or in its body.
Primitive primitive_of(const Shape& shape, const Pose& pose, std::uint32_t id) {
  Primitive s;
  const Vec3 half = half_extents(shape);
  s.kind = kind_of(shape, pose.orientation);
  s.id = id;
  s.sx = shape.kind == ShapeKind::box ? half.x() : shape.size.x();
  s.sy = half.y();
  s.sz = 0.5 * shape.size.z();
  const Mat3 turn = pose.orientation.toRotationMatrix();
  for (int k = 0; k < 3; ++k) {
    s.half[k] = half[k];
    s.position[k] = pose.position[k];
    for (int i = 0; i < 3; ++i) s.axes[3 * k + i] = turn(i, k);
  }
  return s;
}

/// Whether the shape is a primitive. Heightmaps, which are primitives only in scenery, are handled before.
bool has_bounds(const Shape& shape) {
  return shape.kind != ShapeKind::plane && shape.kind != ShapeKind::mesh && shape.kind != ShapeKind::heightmap;
}

/// Returns the box around `box`, which is given in the frame of `pose`.
Aabb placed(const Aabb& box, const Pose& pose) {
  Shape around = Shape::box(box.high - box.low);
  return bounds_of(around, pose * Pose{0.5 * (box.low + box.high), Quat::Identity()});
}

}  // namespace

void SceneTable::build(const SceneIndex& scene, const HeightTrees& trees) {
  primitives_.clear();
  heightmaps_.clear();
  planes_.clear();
  bodies_.clear();
  robots_.assign(scene.robots.size(), {});
  std::vector<std::uint32_t> primitive_of_collider(scene.colliders.size());
  for (std::uint32_t i = 0; i < scene.colliders.size(); ++i) {
    const Collider& c = scene.colliders[i];
    bodies_.push_back(c.body);
    if (c.shape->kind == ShapeKind::heightmap && c.robot == no_robot) {
      const HeightTree* tree = trees.find(*c.shape);
      if (!tree) continue;
      primitive_of_collider[i] = std::uint32_t(primitives_.size());
      Primitive s;
      s.kind = PrimitiveKind::heightmap;
      s.id = i;
      s.heightmap = std::uint32_t(heightmaps_.size());
      primitives_.push_back(s);
      heightmaps_.push_back({tree, tree->field(), c.pose(), i});
      continue;
    }
    if (!has_bounds(*c.shape)) continue;
    primitive_of_collider[i] = std::uint32_t(primitives_.size());
    if (c.robot == no_robot) {
      primitives_.push_back(primitive_of(*c.shape, c.pose(), i));
      continue;
    }
    PrimitiveRange& range = robots_[index_of(c.robot)];
    if (range.count++ == 0) range.first = primitive_of_collider[i];
    Primitive s = primitive_of(*c.shape, c.shape->origin, i);
    if (s.kind == PrimitiveKind::aligned_box) s.kind = PrimitiveKind::box;  // the body may turn
    s.body = c.body_pose->position.data();
    primitives_.push_back(s);
  }
  for (const std::uint32_t i : scene.planes) planes_.push_back({.id = i, .robot = index_of(scene.colliders[i].robot)});

  Vec3 centre = Vec3::Zero();
  if (!scene.scenery.nodes.empty())
    centre = 0.5 * (scene.scenery.nodes[0].bounds.low + scene.scenery.nodes[0].bounds.high);
  scenery_.reserve(scene.scenery.items.size(), centre);
  moving_.reserve(scene.robots.size(), centre);
  scenery_.clear();
  for (const std::uint32_t i : scene.scenery.items)
    if (const Collider& c = scene.colliders[i]; has_bounds(*c.shape))
      scenery_.add(bounds_of(c), primitive_of_collider[i]);
    else if (const HeightTree* tree = c.shape->kind == ShapeKind::heightmap ? trees.find(*c.shape) : nullptr)
      scenery_.add(placed(tree->bounds(), c.pose()), primitive_of_collider[i]);
  scenery_.finish();
  update(scene);
}

void SceneTable::update(const SceneIndex& scene) {
  moving_.clear();
  for (const std::uint32_t r : scene.moving.items) moving_.add(scene.robots[r].bounds, r);
  moving_.finish();
  for (Plane& p : planes_) {
    const Pose pose = scene.colliders[p.id].pose();
    const Vec3 normal = pose.orientation * Vec3::UnitZ();
    for (int k = 0; k < 3; ++k) p.normal[k] = normal[k];
    p.offset = normal.dot(pose.position);
  }
}

void SceneTable::place_heightmaps(const Vec3& start, PlacedHeightmap* placed) const {
  for (const SceneryHeightmap& h : heightmaps_) {
    const Mat3 turn = h.pose.orientation.toRotationMatrix();
    const Vec3 origin = turn.transpose() * (start - h.pose.position);
    placed->field = &h.field;
    placed->id = h.id;
    placed->contains_the_start = heightmap::contains(h.tree->heightmap(), origin);
    for (int k = 0; k < 3; ++k) {
      placed->origin[k] = origin[k];
      for (int i = 0; i < 3; ++i) placed->axes[3 * k + i] = turn(i, k);
    }
    ++placed;
  }
}

SceneView SceneTable::view() const {
  SceneView s;
  s.scenery = scenery_.table();
  s.moving = moving_.table();
  s.primitives = primitives_.data();
  s.robots = robots_.data();
  s.planes = planes_.data();
  s.plane_count = std::uint32_t(planes_.size());
  return s;
}

}  // namespace muro::raycast
