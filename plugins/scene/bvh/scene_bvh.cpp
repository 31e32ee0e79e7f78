// SPDX-License-Identifier: MIT
#include "scene_bvh.hpp"

#include <cstddef>
#include <cstring>
#include <string>

#include "muro/base/bounds.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/mesh/collision_mesh.hpp"
#include "plugins/common/text/quote.hpp"
#include "swept_box.hpp"

namespace muro::bvh {

namespace {

constexpr Parameter parameters[] = {
    real("margin", "m", 0.1,
         "by which a robot's fat AABB is larger than its AABB, so that it need not follow in each step")
        .between(0, 100),
};
constexpr PropertyUse reads[] = {{"collision.shapes", "of all objects"}, {"pose", "of all objects with shapes"}};
constexpr PropertyUse writes[] = {{"scene.index", "on the world object"}};

constexpr Phase all_phases[] = {{Phase::IndexSpace::robots, Phase::Scope::own_robot}, {Phase::IndexSpace::whole}};

/// Fraction of the margin that is moved from behind to ahead of a robot that has left its fat AABB: the robot will
/// probably move on in the same direction.
constexpr double shift_ahead = 0.75;

// BoundsBatch::bounds relies on this layout
static_assert(offsetof(RobotColliders, fat_aabb) == offsetof(RobotColliders, bounds) + 6 * sizeof(double));

}  // namespace

constinit const Description description{
    .id = "scene.bvh",
    .kind = Kind::scene,
    .version = version,
    .summary = "The spatial index: bounding volume hierarchies of scenery and of robots, for collision, rays and radio",
    .parameters = parameters,
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | allocation_free | restorable,
};

/// Returns the shape, or the bounding box of a mesh or heightmap; nothing if an earlier algorithm refused its file.
std::optional<Shape> SceneBvh::bounding_shape(Connector& c, ObjectId body, const Shape& shape) {
  const bool is_mesh = shape.kind == ShapeKind::mesh;
  if (!is_mesh && shape.kind != ShapeKind::heightmap) return shape;
  const std::string path(c.text(shape.mesh));
  try {
    const Aabb box = is_mesh ? mesh::bounds_of(meshes_.mesh(path, shape.size))
                             : heightmap::bounds_of(heightmaps_.file(path).heightmap(shape.size));
    Shape around = Shape::box(box.high - box.low);
    around.origin = shape.origin * Pose{0.5 * (box.low + box.high), Quat::Identity()};
    return around;
  } catch (const Error& error) {
    mesh::refuse_collision_mesh(c, body, error);
    return std::nullopt;
  }
}

void SceneBvh::add_colliders(Connector& c, ObjectId body, const Pose* pose) {
  const Rows<Shape> shapes = c.constant_array(body, keys::collision_shapes);
  for (std::uint32_t i = 0; i < shapes.size(); ++i) {
    const std::optional<Shape> bounding = bounding_shape(c, body, shapes[i]);
    if (!bounding) continue;
    if (shapes[i].kind == ShapeKind::plane) planes_.push_back(std::uint32_t(colliders_.size()));
    Collider k;
    k.shape = &shapes[i];
    k.body_pose = pose;
    k.body = body;
    k.robot = c.robot_of(body);
    k.shape_index = i;
    colliders_.push_back(k);
    bounding_shapes_.push_back(*bounding);
  }
}

void SceneBvh::add_scenery(Connector& c) {
  for (std::uint32_t i = 0; i < c.object_count(); ++i) {
    const ObjectId o{i};
    if (c.robot_of(o) != no_robot || c.constant_array(o, keys::collision_shapes).empty()) continue;
    add_colliders(c, o, &scenery_poses_.emplace_back(c.constant(o, keys::pose).value_or(Pose{})));
  }
  scenery_ = std::uint32_t(colliders_.size());
}

void SceneBvh::add_robot(Connector& c, const RobotView& robot) {
  const auto first = std::uint32_t(colliders_.size());
  std::vector<bool> follows;
  std::vector<LinkBox> boxes;
  for (const Link& link : robot.links) follows.push_back(c.is_used(link.object, keys::pose, usage::derived));
  for (std::uint32_t link = 0; link < robot.links.size(); ++link) {
    const ObjectId body = robot.links[link].object;
    const Rows<Shape> shapes = c.constant_array(body, keys::collision_shapes);
    const std::size_t first_of_body = bounding_shapes_.size();
    if (!shapes.empty()) add_colliders(c, body, c.read(body, keys::pose).get());
    for (const Shape& s : std::span(bounding_shapes_).subspan(first_of_body))
      if (s.kind != ShapeKind::plane) boxes.push_back(swept_box(robot.links, follows, link, s));
  }
  robots_.push_back({first, std::uint32_t(colliders_.size()) - first, {}, {}});
  RobotPoses& poses = poses_.emplace_back();
  std::vector<RoundedBox> rounded;
  for (const LinkBox& b : merged(std::move(boxes))) {
    RoundedBox& box = rounded.emplace_back();
    const double* const pose = lane::numbers(c.read(robot.links[b.link].object, keys::pose).get());
    if (b.link == 0) poses.base = pose;
    box.pose = location_of(poses, pose);
    Vec3::Map(box.centre) = b.centre;
    Vec3::Map(box.half) = b.half;
    box.ball = b.ball;
  }
  if (!rounded.empty()) {
    members_.push_back(index_of(robot.id));
    if (c.constant(robot.base(), keys::shadow_of))
      shadows_.insert(index_of(robot.id));
    else
      in_tree_.push_back(index_of(robot.id));
    add_to_group(groups_, std::move(rounded), index_of(robot.id));
  }
}

void SceneBvh::connect(Connector& c) {
  margin_ = c.parameters().real("margin");
  kernels_ = &bounds_kernels_for(lane::best_isa());
  index_ = c.derived(world_object, keys::scene_index);
  add_scenery(c);
  for (const RobotView* robot : c.robots()) {
    add_robot(c, *robot);
    views_.push_back(robot);
  }
  outside_.resize(robots_.size());
  changes_.resize(robots_.size());
}

std::span<const Phase> SceneBvh::phases() const { return all_phases; }

void SceneBvh::start() {
  std::vector<Aabb> boxes;
  std::vector<std::uint32_t> bounded;
  for (std::uint32_t k = 0; k < scenery_; ++k) {
    const Shape& s = bounding_shapes_[k];
    boxes.push_back(bounds_of(s, *colliders_[k].body_pose * s.origin));
    if (colliders_[k].shape->kind != ShapeKind::plane) bounded.push_back(k);
  }
  scenery_tree_.build(boxes, bounded);
  update_bounds({0, std::uint32_t(robots_.size())});
  boxes.assign(robots_.size(), {});
  for (const std::uint32_t r : members_) {
    robots_[r].fat_aabb = {};
    set_fat_aabb(r);
    boxes[r] = robots_[r].fat_aabb;
  }
  moving_tree_.build(boxes, in_tree_);
  *index_ = {colliders_, robots_, planes_, scenery_tree_.view(), moving_tree_.view(), changes_, all_changes_};
}

void SceneBvh::step(const Step& step, Range range) {
  if (step.phase == 0)
    update_bounds(range);
  else
    update_tree();
}

void SceneBvh::update_bounds(Range block) {
  BoundsBatch batch;
  for (const auto& group : groups_) {
    batch.boxes = group.structure.data();
    batch.box_count = int(group.structure.size());
    const std::span<const std::uint32_t> robots = group.in(block);
    for (std::size_t first = 0; first < robots.size(); first += 8) {
      batch.used = int(std::min<std::size_t>(8, robots.size() - first));
      for (int i = 0; i < batch.used; ++i) {
        const std::uint32_t r = robots[first + std::size_t(i)];
        batch.poses[i] = poses_[r];
        batch.bounds[i] = robots_[r].bounds.low.data();
      }
      const unsigned outside = kernels_->update(batch);
      for (int i = 0; outside >> i; ++i)
        if (outside >> i & 1) outside_[robots[first + std::size_t(i)]] = 1;
    }
  }
}

void SceneBvh::set_fat_aabb(std::uint32_t robot) {
  constexpr double farthest = 1e15;  // m; the comparisons also find values that are no numbers
  RobotColliders& r = robots_[robot];
  if (!(r.bounds.low.minCoeff() >= -farthest && r.bounds.high.maxCoeff() <= farthest) || !r.bounds.low.allFinite() ||
      !r.bounds.high.allFinite())
    throw Error(
        "the pose of robot " + quote(views_[robot]->name) +
        " is not finite, or beyond all bounds; look at what moves it: raise the rate of its motion, or lower the "
        "forces on it");
  const Aabb old = r.fat_aabb;
  for (Eigen::Index axis = 0; axis < 3; ++axis) {
    const bool up = r.bounds.high[axis] > old.high[axis], down = r.bounds.low[axis] < old.low[axis];
    const double ahead = up == down ? 0.0 : up ? shift_ahead : -shift_ahead;
    r.fat_aabb.low[axis] = r.bounds.low[axis] - margin_ * (1 - ahead);
    r.fat_aabb.high[axis] = r.bounds.high[axis] + margin_ * (1 + ahead);
  }
  ++changes_[robot];
  ++all_changes_;
  outside_[robot] = 0;
}

/// Updates the tree for the robots that have left their fat AABBs.
void SceneBvh::update_tree() {
  if (outside_.empty()) return;
  const std::uint64_t before = all_changes_;
  const std::uint8_t *const begin = outside_.data(), *const end = begin + outside_.size();
  for (auto at = begin; (at = static_cast<const std::uint8_t*>(std::memchr(at, 1, std::size_t(end - at)))); ++at) {
    const auto r = std::uint32_t(at - begin);
    set_fat_aabb(r);
    if (shadows_.count(r) == 0) moving_tree_.move(r, robots_[r].fat_aabb);
  }
  if (all_changes_ == before) return;
  if (moving_tree_.is_degraded()) moving_tree_.rebuild();
  index_->moving = moving_tree_.view();
  index_->all_changes = all_changes_;
}

}  // namespace muro::bvh
