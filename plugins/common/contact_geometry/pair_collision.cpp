// SPDX-License-Identifier: MIT
#include "pair_collision.hpp"

#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstddef>
#include <limits>
#include <tuple>

#include "contact_responsibility.hpp"
#include "muro/base/bounds.hpp"

namespace muro::contact_geometry {
namespace {

static_assert(offsetof(ContactPoint, normal) == offsetof(ContactPoint, point) + 3 * sizeof(double) &&
              offsetof(ContactPoint, depth) == offsetof(ContactPoint, point) + 6 * sizeof(double));

const TransformedCollider& collider_of(const TransformedCollider& c) { return c; }
const TransformedCollider& collider_of(const TransformedCollider* c) { return *c; }

/// Returns the end of the colliders of the body to which `first` belongs.
template <class It>
It end_of_body(It first, It end) {
  const ObjectId body = collider_of(*first).collider->body;
  return std::find_if(first, end, [body](const auto& c) { return collider_of(c).collider->body != body; });
}

/// Calls `visit` for all places in their order, as long as it returns true. Returns whether all were visited.
template <class Visit>
bool merge(const Candidates& candidates, const Visit& visit) {
  auto s = candidates.with_scenery.begin();
  auto r = candidates.with_robots.begin();
  const auto end = candidates.with_scenery.end(), robots_end = candidates.with_robots.end();
  while (s != end || r != robots_end) {
    const bool next_is_scenery = r == robots_end || (s != end && s->body_and_rank < r->body_and_rank);
    if (!visit(next_is_scenery ? *s++ : *r++)) return false;
  }
  return true;
}

/// Returns the radius (m) of a ball about `centre` that holds the shape.
double radius_about(const Vec3& centre, const TransformedShape& shape) {
  constexpr double rounding = 1 + 1e-9;
  double radius = shape.half.norm();
  if (shape.kind == ShapeKind::plane) return std::numeric_limits<double>::infinity();
  if (shape.kind == ShapeKind::sphere) radius = shape.radius();
  if (shape.kind == ShapeKind::capsule) radius = shape.radius() + shape.half.z();
  return rounding * ((shape.centre - centre).norm() + radius);
}

}  // namespace

Contact PairCollision::contact_between(const Collider& own, const Collider& other) const {
  Contact c;
  c.self = own.body;
  c.other = other.body;
  c.self_shape = own.shape_index;
  c.other_shape = other.shape_index;
  c.surface = pair_surface(own.shape->surface, other.shape->surface, friction_rule_);
  return c;
}

void PairCollision::connect(Connector& c) {
  friction_rule_ = friction_rule_of(c);
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
    robots_[index_of(r->id)].world = c.input(r->base(), keys::contact_world, kinematic_world);
    if (robots_[index_of(r->id)].list) connect_own_links(c, *r);
    for (const Link& link : r->links)
      if (!c.constant_array(link.object, keys::collision_shapes).empty()) c.read(link.object, keys::pose);
  }
}

std::span<const Phase> PairCollision::phases() const { return all_phases_; }

void PairCollision::start() {
  if (!is_needed_) return;
  scenery_.clear();
  planes_.clear();
  first_of_body_.clear();
  robots_have_planes_ = false;
  for (Robot& r : robots_) r.has_plane = false;
  std::vector<Aabb> bounds;
  for (const Collider& c : index_->colliders) {
    const auto collider = std::uint32_t(first_of_body_.size());
    first_of_body_.push_back(collider > 0 && (&c)[-1].body == c.body ? first_of_body_.back() : collider);
    const bool is_plane = c.shape->kind == ShapeKind::plane;
    if (c.robot != no_robot) {
      robots_[index_of(c.robot)].has_plane |= is_plane;
      robots_have_planes_ |= is_plane;
      continue;
    }
    const auto number = std::uint32_t(scenery_.size());
    if (is_plane) planes_.push_back(number);
    scenery_.push_back(transformed_collider(number));
    bounds.push_back(scenery_.back().bounds);
  }
  std::vector<std::uint8_t> unbounded;
  for (const Robot& r : robots_) unbounded.push_back(r.has_plane ? 1 : 0);
  overlaps_.start(*index_, std::move(bounds), std::move(unbounded));
  pairs_.clear();
  placed_.clear();
  is_placed_.assign(index_->colliders.size(), 0);
  radii_.clear();
  for (std::uint32_t k = 0; k < index_->colliders.size(); ++k) {
    placed_.push_back(transformed_collider(k));
    radii_.push_back(radius_about(index_->colliders[k].body_pose->position, placed_.back().shape));
  }
  travel_.assign(robots_.size(), 0);
  last_move_.assign(robots_.size(), 0);
  followed_in_.assign(robots_.size(), std::numeric_limits<std::uint64_t>::max() - 1);
  followed_.clear();
  for (const Collider& c : index_->colliders) followed_.push_back(*c.body_pose);
  near_.resize(robots_.size());
  for (std::vector<Near>& near : near_) {
    near.clear();
    near.reserve(8);  // more is rare
  }
  points_.resize(robots_.size());
  for (std::vector<PairPoint>& points : points_) {
    points.clear();
    points.reserve(16);
  }
  start_own_links();
}

void PairCollision::step(const Step& step, Range range) {
  if (!is_needed_) return;
  switch (step.phase) {
    case 0:
      overlaps_.update(*index_);
      if (overlaps_.pair_numbers() > pairs_.size())
        pairs_.resize(std::max<std::size_t>(overlaps_.pair_numbers(), 2 * pairs_.size()));
      is_crowded_ = overlaps_.any_robots();
      is_anyone_near_ = 0;
      return;
    case 1:
      for (std::uint32_t r = range.begin; r < range.end; ++r) {
        find_near_robots(r);
        if (near_[r].empty()) continue;
        follow(r, step.index);
        std::atomic_ref(is_anyone_near_).store(1, std::memory_order_relaxed);
      }
      return;
    case 2:
      for (std::uint32_t r = range.begin; r < range.end; ++r) place_colliders(r);
      return;
    case 3:
      for (std::uint32_t r = range.begin; r < range.end; ++r) {
        points_[r].clear();
        for (const Near& near : near_[r])
          if (near.leads) collide_pair(r, near);
      }
      return;
    default:
      for (std::uint32_t r = range.begin; r < range.end && !own_links_.empty(); ++r)
        if (robots_[r].own_links >= 0) collide_own_links(own_links_[std::size_t(robots_[r].own_links)], step.index);
      return list_contacts(range);
  }
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

/// Whether the first robot precedes the second, in an order that does not depend on who was declared first.
bool PairCollision::precedes(std::uint32_t a, std::uint32_t b) const {
  return robots_[a].order_key != robots_[b].order_key ? robots_[a].order_key < robots_[b].order_key : a < b;
}

bool PairCollision::has_contacts(const Robot& robot) const {
  return robot.list && (robot.lists_all || is_moved_by_forces(*robot.world));
}

/// Whether contacts of the first with the second belong in its list.
bool PairCollision::lists(std::uint32_t robot, std::uint32_t other) const {
  const Robot &mine = robots_[robot], &theirs = robots_[other];
  if (!has_contacts(mine) || theirs.shadow_of != no_robot || mine.shadow_of == RobotId{other}) return false;
  return mine.lists_all || contact_algorithm_resolves(*mine.world, *theirs.world);
}

Candidates& PairCollision::candidates(std::uint32_t robot) {
  thread_local Candidates found;
  const Robot& mine = robots_[robot];
  found.others.clear();
  found.robots.clear();
  found.with_scenery.clear();
  found.with_robots.clear();
  found.found.clear();
  if (!has_contacts(mine)) return found;
  if (lists_scenery(mine)) add_scenery(overlaps_.of(robot, *index_), index_->robots[robot].bounds, found);
  if (const auto points = own_points(robot); !points.empty()) found.robots.push_back({robot, points, true});
  if (is_anyone_near_ == 0) return found;
  for (const Near& near : near_[robot]) {
    if (!near.lists || !touch(near)) continue;
    const Pair& pair = pairs_[near.pair];
    found.robots.push_back({near.robot, {points_[pair.leader].data() + pair.first, pair.count}, near.leads});
  }
  std::sort(found.robots.begin(), found.robots.end(),
            [this](const auto& a, const auto& b) { return precedes(a.robot, b.robot); });
  return found;
}

/// Adds near colliders and all planes, in declared order.
void PairCollision::add_scenery(const OverlapCache::Overlaps& overlaps, const Aabb& bounds,
                                Candidates& candidates) const {
  std::size_t plane = 0;
  const auto add_planes_before = [&](std::uint32_t collider) {
    for (; plane < planes_.size() && planes_[plane] < collider; ++plane)
      candidates.others.push_back(&scenery_[planes_[plane]]);
  };
  for (const std::uint32_t k : overlaps.scenery) {
    if (!scenery_[k].bounds.overlaps(bounds)) continue;
    add_planes_before(k);
    candidates.others.push_back(&scenery_[k]);
  }
  add_planes_before(std::numeric_limits<std::uint32_t>::max());
}

/// Calls `sink(own collider, other collider, points)` for pairs that touch, in the order of the list.
template <class Sink>
void PairCollision::collide_scenery(Candidates& candidates, Sink sink) {
  const auto& own = candidates.own;
  const auto& others = candidates.others;
  std::vector<ContactPoint>& points = candidates.points;
  for (auto body = own.begin(), body_end = body; body != own.end(); body = body_end) {
    body_end = end_of_body(body, own.end());
    for (auto other = others.begin(), other_end = other; other != others.end(); other = other_end) {
      other_end = end_of_body(other, others.end());
      for (auto a = body; a != body_end; ++a) {
        if (a->shape.kind == ShapeKind::plane) continue;  // scenery has no list
        for (auto b = other; b != other_end; ++b) {
          if (!a->bounds.overlaps((*b)->bounds)) continue;
          points.clear();
          collide(*a, **b, points);
          if (!points.empty()) sink(*a, **b, points);
        }
      }
    }
  }
}

/// Adds what two robots have found for each other. `rank`: index of the other in `candidates.robots` plus one.
void PairCollision::add_listed(std::uint32_t robot, std::uint32_t rank, Candidates& candidates) const {
  const Candidates::Partner& partner = candidates.robots[rank - 1];
  // Planes of a robot count only for robots that have a list themselves.
  const bool without_planes = robots_[robot].has_plane && !has_contacts(robots_[partner.robot]);
  for (std::uint32_t i = 0; i < partner.points.size(); ++i) {
    const PairPoint& found = partner.points[i];
    const std::uint32_t own = partner.leads ? found.own : found.other, other = partner.leads ? found.other : found.own;
    if (without_planes && index_->colliders[own].shape->kind == ShapeKind::plane) continue;
    candidates.with_robots.push_back(place_of(own, rank, other, i, found.point.point.data()));
  }
}

/// Whether the contact is one of these colliders.
bool PairCollision::has_places(const Contact& contact, const Candidates::Listed& listed) const {
  const Collider &own = index_->colliders[listed.own()], &other = index_->colliders[listed.other()];
  return contact.self == own.body && contact.other == other.body && contact.self_shape == own.shape_index &&
         contact.other_shape == other.shape_index;
}

void PairCollision::write_numbers(const Candidates::Listed& listed, const Candidates& candidates, Contact& contact) {
  const double* const numbers = listed.numbers ? listed.numbers : candidates.found[listed.number()].point.data();
  const bool leads = listed.rank() == 0 || candidates.robots[listed.rank() - 1].leads;
  contact.point = Vec3::Map(numbers);
  contact.normal = leads ? Vec3(Vec3::Map(numbers + 3)) : Vec3(-Vec3::Map(numbers + 3));
  contact.depth = numbers[6];
}

/// Writes the numbers that were found to the contacts of a list. Returns false if the list is not of these colliders.
bool PairCollision::update_list(std::span<Contact> list, const Candidates& candidates) const {
  if (list.size() != candidates.with_scenery.size() + candidates.with_robots.size()) return false;
  Contact* contact = list.data();
  return merge(candidates, [&](const Candidates::Listed& listed) {
    if (!has_places(*contact, listed)) return false;
    write_numbers(listed, candidates, *contact++);
    return true;
  });
}

/// Fills the list with what has been found, in its order. If the colliders are the same as before, only the numbers
/// change, and the list keeps its revision.
void PairCollision::write_list(const ListOut<Contact>& list, Candidates& candidates) const {
  for (std::vector<Candidates::Listed>* listed : {&candidates.with_scenery, &candidates.with_robots})
    if (!std::is_sorted(listed->begin(), listed->end())) std::sort(listed->begin(), listed->end());
  if (update_list(*list, candidates)) return;
  list.clear();
  merge(candidates, [&](const Candidates::Listed& listed) {
    Contact contact = contact_between(index_->colliders[listed.own()], index_->colliders[listed.other()]);
    write_numbers(listed, candidates, contact);
    list.push_back(contact);
    return true;
  });
}

void PairCollision::list_pairs(std::uint32_t robot, Candidates& candidates) {
  const ListOut<Contact>& list = robots_[robot].list;
  const bool is_mixed = !candidates.robots.empty();  // if so, some of its colliders have been placed
  if (!is_mixed && !(*list).empty()) list.clear();
  if (candidates.others.empty() && !is_mixed) return;
  const RobotColliders& colliders = index_->robots[robot];
  candidates.own.clear();
  for (std::uint32_t k = colliders.first; k < colliders.first + colliders.count; ++k)
    candidates.own.push_back(is_mixed && is_placed(k) ? placed_[k] : transformed_collider(k));
  collide_scenery(candidates, [&](const auto& a, const auto& b, const std::vector<ContactPoint>& points) {
    if (is_mixed) return add_found(a.number, b.number, points, candidates);
    Contact c = contact_between(*a.collider, *b.collider);
    for (const ContactPoint& p : points) {
      c.point = p.point;
      c.normal = p.normal;
      c.depth = p.depth;
      list.push_back(c);
    }
  });
  if (is_mixed) list_found(robot, candidates);
}

void PairCollision::add_found(std::uint32_t own, std::uint32_t other, std::span<const ContactPoint> points,
                              Candidates& candidates) const {
  for (const ContactPoint& p : points) {
    const auto number = std::uint32_t(candidates.found.size());
    candidates.with_scenery.push_back(place_of(own, 0, other, number, nullptr));
    candidates.found.push_back(p);
  }
}

void PairCollision::list_found(std::uint32_t robot, Candidates& candidates) const {
  for (std::uint32_t rank = 1; rank <= candidates.robots.size(); ++rank) add_listed(robot, rank, candidates);
  write_list(robots_[robot].list, candidates);
}

}  // namespace muro::contact_geometry
