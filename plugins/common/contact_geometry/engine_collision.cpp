// SPDX-License-Identifier: MIT
#include "engine_collision.hpp"

#include <algorithm>
#include <cmath>

#include "listing.hpp"
#include "muro/vocabulary.hpp"
#include "resolve.hpp"

namespace muro::encounters {
namespace {

constexpr Phase all_phases[] = {{Phase::IndexSpace::whole}, {Phase::IndexSpace::robots, Phase::Scope::reads_all}};

/// Whether two shapes collide alike, wherever they stand.
bool same_solid(const Shape& a, const Shape& b) { return a.kind == b.kind && a.mesh == b.mesh && a.size == b.size; }

/// Whether all of the box is on the free side of the plane.
bool is_clear(const Aabb& box, const Standing& plane) {
  const Vec3 n = plane.placed.axis(), half = 0.5 * (box.high - box.low);
  return n.dot(0.5 * (box.low + box.high) - plane.placed.centre) > n.cwiseAbs().dot(half);
}

}  // namespace

/// What one thread works with.
struct EngineCollision::Scratch {
  std::unique_ptr<Narrowphase> narrowphase;
  Aabb bounds;  ///< of the robot
  std::vector<Near> own;
  std::vector<Other> others;
  std::vector<std::uint32_t> mates;
  std::vector<Touch> touches;
  std::vector<ContactPoint> points;
};

EngineCollision::EngineCollision(std::unique_ptr<Engine> engine) : engine_(std::move(engine)) {}

EngineCollision::~EngineCollision() = default;

void EngineCollision::connect(Connector& c) {
  for (const RobotView* r : c.robots()) {
    Robot& robot = robots_.emplace_back();
    robot.wants_all = c.is_used(r->base(), keys::contacts, usage::read);
    const bool dynamic = robot.wants_all || c.is_used(r->base(), keys::external_wrench, usage::read_sum);
    if (const auto original = c.constant(r->base(), keys::shadow_of)) robot.shadow_of = c.robot_of(*original);
    if (dynamic) robot.list = c.derived_list(r->base(), keys::contacts);
    robot.key = r->key;
    any_list_ = any_list_ || dynamic;
  }
  if (!any_list_) return;
  index_ = c.read(world_object, keys::scene_index);
  for (const RobotView* r : c.robots()) {
    robots_[r->number].world = c.input(r->base(), keys::contact_world, std::uint64_t{0});
    for (const Link& f : r->links)
      if (!c.constant_array(f.object, keys::collision_shapes).empty()) c.read(f.object, keys::pose);
  }
  const bool exact = c.parameters().text("meshes") == "exact";
  for (std::uint32_t i = 0; i < c.object_count(); ++i)
    for (const Shape& s : c.constant_array(ObjectId{i}, keys::collision_shapes)) add_solids(c, ObjectId{i}, s, exact);
  std::sort(by_shape_.begin(), by_shape_.end(),
            [](const auto& a, const auto& b) { return std::less<>()(a.first, b.first); });
}

std::uint32_t EngineCollision::add_solid(const Solid& solid) {
  solids_.push_back(solid);
  engine_->add(solids_.back());
  return std::uint32_t(solids_.size() - 1);
}

/// Null when the mesh is flat.
const mesh::Hull* EngineCollision::hull_if_any(const std::string& path, const Vec3& scale) {
  try {
    return &meshes_.hull(path, scale);
  } catch (const Error&) {
    return nullptr;
  }
}

void EngineCollision::add_solids(Connector& c, ObjectId body, const Shape& shape, bool exact) {
  const auto known =
      std::find_if(known_.begin(), known_.end(), [&](const auto& k) { return same_solid(k.first, shape); });
  if (known != known_.end()) {
    by_shape_.push_back({&shape, known->second});
    return;
  }
  Solids numbers;
  Solid solid;
  solid.shape = shape;
  if (shape.kind == ShapeKind::mesh) try {
      const std::string path(c.text(shape.mesh));
      const mesh::Mesh& surface = meshes_.mesh(path, shape.size);
      solid.box = mesh::bounds_of(surface);
      if (exact) {
        solid.terrain = &terrains_.emplace_back(surface);
        numbers.usual = add_solid(solid);
        solid.terrain = nullptr;
        solid.hull = hull_if_any(path, shape.size);
      } else {
        solid.hull = &meshes_.hull(path, shape.size);
      }
    } catch (const Error& error) {
      throw Error("`" + std::string(c.object_name(body)) + "`: " + error.what());
    }
  if (shape.kind != ShapeKind::mesh || solid.hull) numbers.convex = add_solid(solid);
  if (numbers.usual == none) numbers.usual = numbers.convex;
  known_.push_back({shape, numbers});
  by_shape_.push_back({&shape, numbers});
}

std::span<const Phase> EngineCollision::phases() const { return all_phases; }

void EngineCollision::start() {
  if (!any_list_) return;
  by_collider_.clear();
  scenery_.clear();
  planes_.clear();
  robots_have_planes_ = false;
  for (Robot& r : robots_) r.has_plane = false;
  std::vector<Aabb> bounds;
  for (const Collider& c : index_->colliders) {
    const auto solids =
        std::lower_bound(by_shape_.begin(), by_shape_.end(), c.shape,
                         [](const auto& entry, const Shape* shape) { return std::less<>()(entry.first, shape); });
    by_collider_.push_back(solids->second);
    const bool plane = c.shape->kind == ShapeKind::plane;
    if (c.robot >= 0) {
      robots_[std::size_t(c.robot)].has_plane |= plane;
      robots_have_planes_ |= plane;
      continue;
    }
    const auto number = std::uint32_t(scenery_.size());
    if (plane) planes_.push_back(number);
    scenery_.push_back(near(number));
    bounds.push_back(scenery_.back().bounds);
  }
  neighbours_.start(*index_, std::move(bounds));
}

EngineCollision::Near EngineCollision::near(std::uint32_t collider) const {
  const Collider& c = index_->colliders[collider];
  const Solids solids = by_collider_[collider];
  Near n{&c, solids, standing(solids_[solids.usual], c.pose()), {}};
  n.bounds = bounds_of(n.at.placed);
  return n;
}

void EngineCollision::step(const Step& step, Range range) {
  if (!any_list_) return;
  if (step.phase == 0) return neighbours_.update(*index_);
  Scratch& scratch = scratch_.here([this] {
    auto fresh = std::make_unique<Scratch>();
    fresh->narrowphase = engine_->narrowphase();
    return fresh;
  });
  for (std::uint32_t r = range.begin; r < range.end; ++r)
    if (robots_[r].list) touch_robot(r, scratch);
}

void EngineCollision::touch_robot(std::uint32_t robot, Scratch& scratch) {
  const Robot& mine = robots_[robot];
  mine.list.clear();
  if (*mine.world == 0 && !mine.wants_all) return;
  const RobotColliders& own = index_->robots[robot];
  const Neighbours::Of& around = neighbours_.of(robot, *index_);
  scratch.bounds = own.bounds;
  scratch.own.clear();
  scratch.others.clear();
  if (mine.wants_all || is_listed(*mine.world, 0)) add_scenery(around, scratch);
  add_mates(robot, around, scratch);
  if (scratch.others.empty()) return;
  for (std::uint32_t k = own.first; k < own.first + own.count; ++k) scratch.own.push_back(near(k));
  list_contacts(mine.list, scratch);
}

/// Near colliders and all planes, as declared.
void EngineCollision::add_scenery(const Neighbours::Of& around, Scratch& scratch) const {
  std::size_t plane = 0;
  const auto add_planes_before = [&](std::uint32_t collider) {
    for (; plane < planes_.size() && planes_[plane] < collider; ++plane)
      scratch.others.push_back({scenery_[planes_[plane]]});
  };
  for (const std::uint32_t k : around.scenery) {
    if (!scenery_[k].bounds.overlaps(scratch.bounds)) continue;
    add_planes_before(k);
    scratch.others.push_back({scenery_[k]});
  }
  add_planes_before(none);
}

/// An order of robots that does not depend on who was declared first.
bool EngineCollision::precedes(std::uint32_t a, std::uint32_t b) const {
  return robots_[a].key != robots_[b].key ? robots_[a].key < robots_[b].key : a < b;
}

/// Ordered by key. A plane reaches everyone.
void EngineCollision::add_mates(std::uint32_t robot, const Neighbours::Of& around, Scratch& scratch) const {
  const Robot& mine = robots_[robot];
  const auto may_touch = [&](std::uint32_t m) {
    const bool shadowed = robots_[m].shadow_of >= 0 || mine.shadow_of == std::int32_t(m);
    return !shadowed && (mine.wants_all || is_listed(*mine.world, *robots_[m].world)) &&
           (mine.has_plane || robots_[m].has_plane || index_->robots[m].bounds.overlaps(scratch.bounds));
  };
  scratch.mates.clear();
  if (!robots_have_planes_) {
    for (const std::uint32_t m : around.mates)
      if (may_touch(m)) scratch.mates.push_back(m);
  } else {
    for (std::uint32_t m = 0; m < robots_.size(); ++m)
      if (m != robot && may_touch(m)) scratch.mates.push_back(m);
  }
  std::sort(scratch.mates.begin(), scratch.mates.end(),
            [this](std::uint32_t a, std::uint32_t b) { return precedes(a, b); });
  for (const std::uint32_t m : scratch.mates) {
    const RobotColliders& theirs = index_->robots[m];
    const bool has_list = robots_[m].list && (robots_[m].wants_all || *robots_[m].world != 0);
    for (std::uint32_t k = theirs.first; k < theirs.first + theirs.count; ++k)
      scratch.others.push_back({near(k), precedes(m, robot), has_list});
  }
}

/// By own body, other body, own shape, other shape.
void EngineCollision::list_contacts(const ListOut<Contact>& list, Scratch& scratch) const {
  for (auto own = scratch.own.begin(), own_end = own; own != scratch.own.end(); own = own_end) {
    own_end = end_of_body(own, scratch.own.end());
    for (auto other = scratch.others.begin(), other_end = other; other != scratch.others.end(); other = other_end) {
      other_end = end_of_body(other, scratch.others.end());
      for (auto a = own; a != own_end; ++a)
        for (auto b = other; b != other_end; ++b) touch_pair(*a, *b, list, scratch);
    }
  }
}

void EngineCollision::touch_pair(const Near& own, const Other& other, const ListOut<Contact>& list,
                                 Scratch& scratch) const {
  // A robot's own plane is touched by those that have a list themselves.
  if (own.at.solid->is_plane() && (!other.has_list || other.at.solid->is_plane())) return;
  if (!own.bounds.overlaps(other.bounds)) return;
  if (other.at.solid->is_plane() ? is_clear(own.bounds, other.at)
                                 : own.at.solid->is_plane() && is_clear(other.bounds, own.at))
    return;
  const Near* a = &own;
  const Near* b = &other;
  if (other.mirrored) std::swap(a, b);
  std::uint32_t number_a = a->solids.usual, number_b = b->solids.usual;
  const auto is_terrain = [this](std::uint32_t number) { return solids_[number].terrain != nullptr; };
  // Of two meshes as they are a robot's is taken as its hull; a plane touches no more of a mesh than its hull.
  if (is_terrain(number_a) && (is_terrain(number_b) || solids_[number_b].is_plane())) {
    number_a = a->solids.convex;
    if (b->collider->robot >= 0) number_b = b->solids.convex;
  } else if (is_terrain(number_b) && solids_[number_a].is_plane()) {
    number_b = b->solids.convex;
  }
  if (number_a == none || number_b == none) return;
  // The second may be a plane or a mesh as it is.
  const bool turned = is_terrain(number_a) || solids_[number_a].is_plane();
  if (turned) std::swap(a, b), std::swap(number_a, number_b);
  scratch.touches.clear();
  scratch.points.clear();
  scratch.narrowphase->touch(number_a, a->at.pose, number_b, b->at.pose, scratch.touches);
  if (scratch.touches.empty()) return;
  const Standing at_a{&solids_[number_a], a->at.pose, a->at.placed}, at_b{&solids_[number_b], b->at.pose, b->at.placed};
  resolve(at_a, at_b, scratch.touches, scratch.points);
  if (scratch.points.empty()) return;
  Contact c = contact_between(*own.collider, *other.collider);
  const double side = a == &own ? 1 : -1;
  for (const ContactPoint& p : scratch.points) {
    c.point = p.point;
    c.normal = side * p.normal;
    c.depth = p.depth;
    list.push_back(c);
  }
}

}  // namespace muro::encounters
