// SPDX-License-Identifier: MIT
#include "pair_collision.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "contact_responsibility.hpp"
#include "muro/toolkit/bounds.hpp"

namespace muro::contact_geometry {
namespace {

constexpr Phase all_phases[] = {{Phase::IndexSpace::whole}, {Phase::IndexSpace::robots, Phase::Scope::reads_all}};

/// Behind the last collider of the body that the first belongs to.
template <class It>
It end_of_body(It first, It end) {
  return std::find_if(first, end, [&](const auto& c) { return c.collider->body != first->collider->body; });
}

}  // namespace

Contact contact_between(const Collider& own, const Collider& other) {
  Contact c;
  c.self = own.body;
  c.other = other.body;
  c.self_shape = own.shape_index;
  c.other_shape = other.shape_index;
  c.friction = std::sqrt(own.shape->friction * other.shape->friction);
  c.restitution = std::max(own.shape->restitution, other.shape->restitution);
  return c;
}

void PairCollision::connect(Connector& c) {
  for (const RobotView* r : c.robots()) {
    Robot& robot = robots_.emplace_back();
    robot.base = r->base();
    robot.order_key = r->key;
    robot.lists_all = c.is_used(r->base(), keys::contacts, usage::read);
    const bool has_list = robot.lists_all || c.is_used(r->base(), keys::external_wrench, usage::read_sum);
    if (has_list) robot.list = c.derived_list(r->base(), keys::contacts);
    if (const auto original = c.constant(r->base(), keys::shadow_of)) robot.shadow_of = c.robot_of(*original);
    is_needed_ = is_needed_ || has_list;
  }
  if (!is_needed_) return;
  index_ = c.read(world_object, keys::scene_index);
  for (const RobotView* r : c.robots()) {
    robots_[r->number].world = c.input(r->base(), keys::contact_world, kinematic_world);
    for (const Link& link : r->links)
      if (!c.constant_array(link.object, keys::collision_shapes).empty()) c.read(link.object, keys::pose);
  }
}

std::span<const Phase> PairCollision::phases() const { return all_phases; }

void PairCollision::start() {
  if (!is_needed_) return;
  scenery_.clear();
  planes_.clear();
  radii_.clear();
  robots_have_planes_ = false;
  for (Robot& r : robots_) r.has_plane = false;
  std::vector<Aabb> bounds;
  for (const Collider& c : index_->colliders) {
    radii_.push_back(radius_about_body(*c.shape));
    const bool is_plane = c.shape->kind == ShapeKind::plane;
    if (c.robot >= 0) {
      robots_[std::size_t(c.robot)].has_plane |= is_plane;
      robots_have_planes_ |= is_plane;
      continue;
    }
    const auto number = std::uint32_t(scenery_.size());
    if (is_plane) planes_.push_back(number);
    scenery_.push_back(transformed_collider(number));
    bounds.push_back(scenery_.back().bounds);
  }
  overlaps_.start(*index_, std::move(bounds));
}

void PairCollision::step(const Step& step, Range range) {
  if (!is_needed_) return;
  if (step.phase == 0)
    overlaps_.update(*index_);
  else
    list_contacts(range);
}

void PairCollision::list_contacts(Range robots) {
  for (std::uint32_t r = robots.begin; r < robots.end; ++r)
    if (robots_[r].list) list_pairs(r, candidates(r));
}

bool PairCollision::lists_scenery(const Robot& robot) const {
  return robot.lists_all || contact_algorithm_resolves(*robot.world, kinematic_world);
}

TransformedCollider PairCollision::transformed_collider(std::uint32_t collider) const {
  const TransformedShape shape = transformed_shape(collider);
  return {&index_->colliders[collider], collider, shape, bounds_of(shape)};
}

/// Bounds of a collider of a robot, however its body is oriented.
Aabb PairCollision::ball(std::uint32_t collider) const {
  const Vec3& centre = index_->colliders[collider].body_pose->position;
  const Vec3 radius = Vec3::Constant(radii_[collider]);
  return {centre - radius, centre + radius};
}

/// An order of robots that does not depend on who was declared first.
bool PairCollision::precedes(std::uint32_t a, std::uint32_t b) const {
  return robots_[a].order_key != robots_[b].order_key ? robots_[a].order_key < robots_[b].order_key : a < b;
}

Candidates& PairCollision::candidates(std::uint32_t robot) {
  thread_local Candidates found;
  const Robot& mine = robots_[robot];
  found.bounds = index_->robots[robot].bounds;
  found.others.clear();
  if (!is_moved_by_forces(*mine.world) && !mine.lists_all) return found;
  const OverlapCache::Overlaps& overlaps = overlaps_.of(robot, *index_);
  if (lists_scenery(mine)) add_scenery(overlaps, found);
  add_robots(robot, overlaps, found);
  return found;
}

/// Near colliders and all planes, as declared.
void PairCollision::add_scenery(const OverlapCache::Overlaps& overlaps, Candidates& candidates) const {
  std::size_t plane = 0;
  const auto add_planes_before = [&](std::uint32_t collider) {
    for (; plane < planes_.size() && planes_[plane] < collider; ++plane)
      candidates.others.push_back({scenery_[planes_[plane]]});
  };
  for (const std::uint32_t k : overlaps.scenery) {
    if (!scenery_[k].bounds.overlaps(candidates.bounds)) continue;
    add_planes_before(k);
    candidates.others.push_back({scenery_[k]});
  }
  add_planes_before(std::numeric_limits<std::uint32_t>::max());
}

/// A plane reaches everyone.
bool PairCollision::may_touch(std::uint32_t robot, std::uint32_t other, const Aabb& bounds) const {
  const Robot &mine = robots_[robot], &theirs = robots_[other];
  if (theirs.shadow_of >= 0 || mine.shadow_of == std::int32_t(other)) return false;
  if (!mine.lists_all && !contact_algorithm_resolves(*mine.world, *theirs.world)) return false;
  return mine.has_plane || theirs.has_plane || index_->robots[other].bounds.overlaps(bounds);
}

/// Colliders of near robots, by order key.
void PairCollision::add_robots(std::uint32_t robot, const OverlapCache::Overlaps& overlaps,
                               Candidates& candidates) const {
  candidates.robots.clear();
  if (!robots_have_planes_) {
    for (const std::uint32_t r : overlaps.robots)
      if (may_touch(robot, r, candidates.bounds)) candidates.robots.push_back(r);
  } else {
    for (std::uint32_t r = 0; r < robots_.size(); ++r)
      if (r != robot && may_touch(robot, r, candidates.bounds)) candidates.robots.push_back(r);
  }
  std::sort(candidates.robots.begin(), candidates.robots.end(),
            [this](std::uint32_t a, std::uint32_t b) { return precedes(a, b); });
  const bool has_plane = robots_[robot].has_plane;
  for (const std::uint32_t r : candidates.robots) {
    const Robot& other = robots_[r];
    const bool has_list = other.list && (other.lists_all || is_moved_by_forces(*other.world));
    const RobotColliders& theirs = index_->robots[r];
    for (std::uint32_t k = theirs.first; k < theirs.first + theirs.count; ++k) {
      if (!has_plane && !ball(k).overlaps(candidates.bounds)) continue;
      const TransformedCollider collider = transformed_collider(k);
      if (has_plane || collider.bounds.overlaps(candidates.bounds))
        candidates.others.push_back({collider, precedes(r, robot), has_list});
    }
  }
}

void PairCollision::list_pairs(std::uint32_t robot, Candidates& candidates) {
  const ListOut<Contact>& list = robots_[robot].list;
  if (!(*list).empty()) list.clear();
  if (candidates.others.empty()) return;
  auto& [bounds, own, others, robots, points] = candidates;
  own.clear();
  const RobotColliders& colliders = index_->robots[robot];
  for (std::uint32_t k = colliders.first; k < colliders.first + colliders.count; ++k)
    own.push_back(transformed_collider(k));
  for (auto body = own.begin(), body_end = body; body != own.end(); body = body_end) {
    body_end = end_of_body(body, own.end());
    for (auto other = others.begin(), other_end = other; other != others.end(); other = other_end) {
      other_end = end_of_body(other, others.end());
      for (auto a = body; a != body_end; ++a)
        for (auto b = other; b != other_end; ++b) list_pair(*a, *b, list, points);
    }
  }
}

void PairCollision::list_pair(const TransformedCollider& own, const Candidates::Other& other,
                              const ListOut<Contact>& list, std::vector<ContactPoint>& points) {
  // A plane of a robot is touched by those that have a list themselves.
  if (own.shape.kind == ShapeKind::plane && (!other.has_list || other.shape.kind == ShapeKind::plane)) return;
  if (!own.bounds.overlaps(other.bounds)) return;
  points.clear();
  if (other.precedes)
    collide(other, own, points);
  else
    collide(own, other, points);
  if (points.empty()) return;
  Contact c = contact_between(*own.collider, *other.collider);
  for (const ContactPoint& p : points) {
    c.point = p.point;
    c.normal = other.precedes ? Vec3(-p.normal) : p.normal;
    c.depth = p.depth;
    list.push_back(c);
  }
}

}  // namespace muro::contact_geometry
