// SPDX-License-Identifier: MIT
#include "scene_table.hpp"

namespace muro::raycast {

namespace {

SolidKind kind_of(const Shape& shape, const Quat& turn) {
  switch (shape.kind) {
    case ShapeKind::sphere:
      return SolidKind::sphere;
    case ShapeKind::cylinder:
      return SolidKind::cylinder;
    case ShapeKind::capsule:
      return SolidKind::capsule;
    default:
      return turn.vec().isZero(0) ? SolidKind::upright_box : SolidKind::box;
  }
}

/// The shape at `pose`, in the world or in its body.
Solid solid_of(const Shape& shape, const Pose& pose, std::uint32_t id) {
  Solid s;
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

bool has_bounds(const Shape& shape) { return shape.kind != ShapeKind::plane && shape.kind != ShapeKind::mesh; }

}  // namespace

void SceneTable::build(const SceneIndex& scene) {
  solids_.clear();
  planes_.clear();
  bodies_.clear();
  robots_.assign(scene.robots.size(), {});
  std::vector<std::uint32_t> solid_of_collider(scene.colliders.size());
  for (std::uint32_t i = 0; i < scene.colliders.size(); ++i) {
    const Collider& c = scene.colliders[i];
    bodies_.push_back(c.body);
    if (!has_bounds(*c.shape)) continue;
    solid_of_collider[i] = std::uint32_t(solids_.size());
    if (c.robot < 0) {
      solids_.push_back(solid_of(*c.shape, c.pose(), i));
      continue;
    }
    SolidRange& range = robots_[std::size_t(c.robot)];
    if (range.count++ == 0) range.first = solid_of_collider[i];
    Solid s = solid_of(*c.shape, c.shape->origin, i);
    if (s.kind == SolidKind::upright_box) s.kind = SolidKind::box;  // its body turns
    s.body = c.body_pose->position.data();
    solids_.push_back(s);
  }
  for (const std::uint32_t i : scene.planes) planes_.push_back({.id = i, .robot = scene.colliders[i].robot});

  Vec3 centre = Vec3::Zero();
  if (!scene.scenery.nodes.empty())
    centre = 0.5 * (scene.scenery.nodes[0].bounds.low + scene.scenery.nodes[0].bounds.high);
  scenery_.reserve(scene.scenery.items.size(), centre);
  moving_.reserve(scene.robots.size(), centre);
  scenery_.clear();
  for (const std::uint32_t i : scene.scenery.items)
    if (has_bounds(*scene.colliders[i].shape)) scenery_.add(scene.colliders[i].bounds(), solid_of_collider[i]);
  scenery_.close();
  update(scene);
}

void SceneTable::update(const SceneIndex& scene) {
  moving_.clear();
  for (const std::uint32_t r : scene.moving.items) moving_.add(scene.robots[r].bounds, r);
  moving_.close();
  for (Plane& p : planes_) {
    const Pose pose = scene.colliders[p.id].pose();
    const Vec3 normal = pose.orientation * Vec3::UnitZ();
    for (int k = 0; k < 3; ++k) p.normal[k] = normal[k];
    p.offset = normal.dot(pose.position);
  }
}

Sight SceneTable::sight() const {
  Sight s;
  s.scenery = scenery_.view();
  s.moving = moving_.view();
  s.solids = solids_.data();
  s.robots = robots_.data();
  s.planes = planes_.data();
  s.plane_count = std::uint32_t(planes_.size());
  return s;
}

}  // namespace muro::raycast
