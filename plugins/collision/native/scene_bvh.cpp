// SPDX-License-Identifier: MIT
#include "scene_bvh.hpp"

#include <algorithm>
#include <string>

#include "muro/vocabulary.hpp"

namespace muro::native {

namespace {

constexpr Parameter parameters[] = {
    real("margin", "m", 0.1, "by which a robot's box is larger than the robot, so that it need not follow each step")
        .between(0, 100),
};
constexpr Use reads[] = {{"collision.shapes", "of all objects"}, {"pose", "of all objects with shapes"}};
constexpr Use writes[] = {{"scene.index", "on the world object"}};

}  // namespace

constinit const Description scene_bvh_description{
    .id = "scene.bvh",
    .kind = Kind::scene,
    .version = "1.0.0",
    .summary = "The spatial index: bounding volume hierarchies of scenery and of robots, for collision, rays and radio",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .promises = deterministic | allocation_free | restorable,
};

void SceneBvh::warn_of_mesh(Connector& c, ObjectId body, TextId mesh) {
  if (std::find(meshes_.begin(), meshes_.end(), mesh) != meshes_.end()) return;
  meshes_.push_back(mesh);
  c.host().log(LogLevel::warning,
               "`" + std::string(c.object_name(body)) + "`: mesh " + std::string(c.text(mesh)) +
                   " has no place in scene.bvh, so nothing collides with it and no ray sees it; give the "
                   "body boxes, spheres, cylinders or capsules for collision");
}

void SceneBvh::add_colliders(Connector& c, ObjectId body, const Pose* pose) {
  const std::span<const Shape> shapes = c.constant_array(body, keys::collision_shapes);
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    if (shapes[i].kind == ShapeKind::mesh) {
      warn_of_mesh(c, body, shapes[i].mesh);
      continue;
    }
    if (shapes[i].kind == ShapeKind::plane) planes_.push_back(std::uint32_t(colliders_.size()));
    Collider k;
    k.shape = &shapes[i];
    k.body_pose = pose;
    k.body = body;
    k.robot = c.robot_of(body);
    k.shape_index = i;
    colliders_.push_back(k);
  }
}

void SceneBvh::connect(Connector& c) {
  margin_ = c.parameters().real("margin");
  index_ = c.derived(world_object, keys::scene_index);
  for (std::uint32_t i = 0; i < c.object_count(); ++i) {
    const ObjectId o{i};
    if (c.robot_of(o) >= 0 || c.constant_array(o, keys::collision_shapes).empty()) continue;
    add_colliders(c, o, &scenery_poses_.emplace_back(c.constant(o, keys::pose).value_or(Pose{})));
  }
  scenery_ = std::uint32_t(colliders_.size());
  for (const RobotView* robot : c.robots()) {
    RobotColliders r;
    r.first = std::uint32_t(colliders_.size());
    for (const Frame& f : robot->frames)
      if (!c.constant_array(f.object, keys::collision_shapes).empty())
        add_colliders(c, f.object, c.read(f.object, keys::pose).get());
    r.count = std::uint32_t(colliders_.size()) - r.first;
    robots_.push_back(r);
  }
}

void SceneBvh::start() {
  std::vector<Aabb> boxes;
  std::vector<std::uint32_t> bounded;
  for (std::uint32_t k = 0; k < scenery_; ++k) {
    boxes.push_back(colliders_[k].bounds());
    if (colliders_[k].shape->kind != ShapeKind::plane) bounded.push_back(k);
  }
  scenery_tree_.build(boxes, bounded);
  members_.clear();
  for (std::uint32_t r = 0; r < robots_.size(); ++r) {
    place(r);
    if ((robots_[r].bounds.low.array() <= robots_[r].bounds.high.array()).all()) members_.push_back(r);
  }
  fat_.resize(robots_.size());
  rebuild();
  *index_ = {colliders_, robots_, planes_, scenery_tree_.view(), moving_tree_.view(), changes_};
}

void SceneBvh::place(std::uint32_t robot) {
  RobotColliders& r = robots_[robot];
  r.bounds = {};
  for (std::uint32_t k = r.first; k < r.first + r.count; ++k) {
    const Collider& c = colliders_[k];
    if (c.shape->kind != ShapeKind::plane) r.bounds.include(c.bounds());
  }
}

void SceneBvh::rebuild() {
  const Vec3 margin = Vec3::Constant(margin_);
  for (const std::uint32_t r : members_) {
    fat_[r] = robots_[r].room = {robots_[r].bounds.low - margin, robots_[r].bounds.high + margin};
    ++robots_[r].changes;
    ++changes_;
  }
  moving_tree_.build(fat_, members_);
  strayed_ = 0;
}

void SceneBvh::step(const Step&, Range) {
  const Vec3 margin = Vec3::Constant(margin_);
  std::size_t left = 0;
  for (const std::uint32_t r : members_) {
    place(r);
    if (fat_[r].contains(robots_[r].bounds)) continue;
    fat_[r] = robots_[r].room = {robots_[r].bounds.low - margin, robots_[r].bounds.high + margin};
    ++robots_[r].changes;
    ++left;
  }
  if (left == 0) return;
  strayed_ += left;
  changes_ += left;
  if (strayed_ > members_.size())  // the tree was made for other places
    rebuild();
  else
    moving_tree_.refit(fat_);
  index_->moving = moving_tree_.view();
  index_->changes = changes_;
}

}  // namespace muro::native
