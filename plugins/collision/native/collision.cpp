// SPDX-License-Identifier: MIT
#include "collision.hpp"

#include <bit>
#include <cstddef>
#include <limits>

#include "mesh_warning.hpp"
#include "muro/vocabulary.hpp"
#include "plugins/common/contact_geometry/listing.hpp"

namespace muro::native {

namespace {

constexpr PropertyUse reads[] = {{"scene.index", "shapes and boxes"},
                                 {"pose", "of all bodies of robots with shapes"},
                                 {"contact.world", "of all robots: who answers for which contacts"}};
constexpr PropertyUse writes[] = {{"contacts", "list on the base of every robot that forces move"}};
constexpr Phase all_phases[] = {{Phase::IndexSpace::whole}, {Phase::IndexSpace::robots, Phase::Scope::reads_all}};

/// No points have this signature.
constexpr double unknown = -1;
constexpr int lane_width = 8, points_of_slot = 8;

// what GroundWork::contacts counts on
static_assert(offsetof(Contact, depth) == offsetof(Contact, point) + depth_number * sizeof(double));
static_assert(sizeof(Contact) % sizeof(double) == 0);

}  // namespace

constinit const Description collision_description{
    .id = "collision.native",
    .kind = Kind::collision,
    .version = "1.1.0",
    .summary =
        "Contact points between boxes, spheres, cylinders, capsules and planes, in closed form where there is one",
    .parameters = {},
    .reads = reads,
    .writes = writes,
    .capabilities = deterministic | allocation_free | restorable,
};

/// Robots of a team that are worked out together.
struct NativeCollision::Lane {
  GroundWork work;
  std::uint32_t robots[lane_width];
};

void NativeCollision::connect(Connector& c) {
  kernels_ = &ground_kernels_for(lane::best_isa());
  for (const RobotView* r : c.robots()) {
    Robot& robot = robots_.emplace_back();
    robot.wants_all = c.is_used(r->base(), keys::contacts, usage::read);
    const bool dynamic = robot.wants_all || c.is_used(r->base(), keys::external_wrench, usage::read_sum);
    if (dynamic) robot.list = c.derived_list(r->base(), keys::contacts);
    robot.key = r->key;
    if (const auto original = c.constant(r->base(), keys::shadow_of)) robot.shadow_of = c.robot_of(*original);
    robot.world = c.input(r->base(), keys::contact_world, std::uint64_t{0});
    any_list_ = any_list_ || dynamic;
  }
  if (!any_list_) return;
  warn_of_meshes(c);
  index_ = c.read(world_object, keys::scene_index);
  for (const RobotView* r : c.robots())
    for (const Link& f : r->links) {
      if (c.constant_array(f.object, keys::collision_shapes).empty()) continue;
      const double* const pose = lane::numbers(c.read(f.object, keys::pose).get());
      if (f.object == r->base()) robots_[r->number].poses.base = pose;
    }
}

std::span<const Phase> NativeCollision::phases() const { return all_phases; }

void NativeCollision::start() {
  if (!any_list_) return;
  start_scenery();
  start_robots();
}

void NativeCollision::start_scenery() {
  scenery_.clear();
  planes_.clear();
  grounds_.clear();
  std::vector<Aabb> bounds;
  for (const Collider& c : index_->colliders) {
    if (c.robot >= 0) break;
    const Placed p = placed(solid_of(*c.shape), *c.body_pose);
    if (p.kind == ShapeKind::plane) {
      planes_.push_back(std::uint32_t(scenery_.size()));
      grounds_.push_back(ground_of(p));
    }
    scenery_.push_back({&c, p, bounds_of(p)});
    bounds.push_back(scenery_.back().bounds);
  }
  neighbours_.start(*index_, std::move(bounds));
}

/// How many words a signature has.
int NativeCollision::words(std::uint32_t solids) const { return words_of(int(solids), int(planes_.size())); }

void NativeCollision::start_robots() {
  const SceneIndex& scene = *index_;
  solids_.clear();
  reaches_.clear();
  teams_.clear();
  robots_have_planes_ = false;
  std::size_t all_words = 0;
  for (std::uint32_t r = 0; r < robots_.size(); ++r) {
    const std::span<const Collider> own = scene.colliders.subspan(scene.robots[r].first, scene.robots[r].count);
    std::vector<Solid> solids;
    robots_[r].has_plane = false;
    robots_[r].poses.links = nullptr;
    for (const Collider& c : own) {
      const bool same_body = !solids.empty() && (&c)[-1].body == c.body;
      solids.push_back(solid_of(*c.shape, solids.empty() ? 0 : solids.back().body + !same_body));
      solids.back().pose = spot_of(robots_[r].poses, lane::numbers(c.body_pose));
      robots_[r].has_plane = robots_[r].has_plane || c.shape->kind == ShapeKind::plane;
    }
    robots_have_planes_ = robots_have_planes_ || robots_[r].has_plane;
    for (const Solid& s : solids) reaches_.push_back(reach_of(s));
    solids_.insert(solids_.end(), solids.begin(), solids.end());
    if (!robots_[r].list) continue;
    all_words += std::size_t(words(scene.robots[r].count));
    // room for all that kernels may write
    for (std::size_t i = 0; i < points_of_slot * own.size() * planes_.size(); ++i) robots_[r].list.push_back({});
    robots_[r].list.clear();
    join_team(teams_, std::move(solids), r);
  }
  signatures_.assign(all_words, unknown);
  double* next = signatures_.data();
  for (std::uint32_t r = 0; r < robots_.size(); ++r) {
    if (!robots_[r].list) continue;
    robots_[r].signature = next;
    next += words(scene.robots[r].count);
  }
}

void NativeCollision::step(const Step& step, Range range) {
  if (!any_list_) return;
  if (step.phase == 0)
    neighbours_.update(*index_);
  else
    touch(range);
}

void NativeCollision::touch(Range block) {
  Lane lane;
  lane.work.contact_stride = sizeof(Contact) / sizeof(double);
  lane.work.planes = grounds_.data();
  lane.work.plane_count = int(grounds_.size());
  for (const auto& team : teams_) {
    lane.work.solids = team.structure.data();
    lane.work.solid_count = int(team.structure.size());
    lane.work.used = 0;
    for (const std::uint32_t r : team.in(block)) {
      const Neighbours::Of& near = neighbours_.of(r, *index_);
      if (*robots_[r].world != keys::contact_for_all && !robots_[r].wants_all) {
        touch_other_worlds(r, near);
        continue;
      }
      if (!alone(r, near) && touch_pairs(r, near)) continue;
      const int i = lane.work.used++;
      lane.robots[i] = r;
      const Robot& robot = robots_[r];
      lane.work.poses[i] = robot.poses;
      lane.work.contacts[i] = (*robot.list).data()->point.data();
      lane.work.signatures[i] = robot.signature;
      if (lane.work.used == lane_width) touch_ground(lane);
    }
    if (lane.work.used > 0) touch_ground(lane);
  }
}

/// Whether nothing but planes of the scenery can be touched.
bool NativeCollision::alone(std::uint32_t robot, const Neighbours::Of& near) const {
  if (robots_have_planes_) return false;
  if (near.scenery.empty() && near.mates.empty()) return true;
  const Aabb& bounds = index_->robots[robot].bounds;
  for (const std::uint32_t k : near.scenery)
    if (scenery_[k].bounds.overlaps(bounds)) return false;
  for (const std::uint32_t mate : near.mates)
    if (index_->robots[mate].bounds.overlaps(bounds)) return false;
  return true;
}

void NativeCollision::touch_ground(Lane& lane) const {
  for (unsigned changed = kernels_->touch(lane.work); changed != 0; changed &= changed - 1)
    list_ground(lane.robots[std::countr_zero(changed)]);
  lane.work.used = 0;
}

/// Makes the list of a robot after its signature: the points and depths are in their places already.
void NativeCollision::list_ground(std::uint32_t robot) const {
  const Robot& mine = robots_[robot];
  Contact* const contacts = (*mine.list).data();
  const RobotColliders& own = index_->robots[robot];
  mine.list.clear();
  std::size_t slot = 0, written = 0;
  const Solid* const solids = solids_.data() + (own.first - scenery_.size());
  for (std::uint32_t begin = 0, end = 0; begin < own.count; begin = end) {
    while (end < own.count && solids[end].body == solids[begin].body) ++end;
    for (std::size_t p = 0; p < planes_.size(); ++p)
      for (std::uint32_t k = begin; k < end; ++k, ++slot) {
        const double word = mine.signature[slot / slots_of_word];
        const auto points = unsigned(std::uint64_t(word) >> (8 * (slot % slots_of_word)) & 0xff);
        if (points == 0) continue;
        Contact c = contact_between(index_->colliders[own.first + k], *scenery_[planes_[p]].collider);
        c.normal = Vec3::Map(grounds_[p].normal);
        for (int n = std::popcount(points); n > 0; --n, ++written) {
          c.point = contacts[written].point;
          c.depth = contacts[written].depth;
          mine.list.push_back(c);
        }
      }
  }
}

Near NativeCollision::near(std::uint32_t collider) const {
  const Collider& c = index_->colliders[collider];
  const Placed p = placed(solids_[collider - scenery_.size()], *c.body_pose);
  return {&c, p, bounds_of(p)};
}

/// Around a collider of a robot, however its body is turned.
Aabb NativeCollision::ball(std::uint32_t collider) const {
  const Vec3& centre = index_->colliders[collider].body_pose->position;
  const Vec3 reach = Vec3::Constant(reaches_[collider - scenery_.size()]);
  return {centre - reach, centre + reach};
}

/// An order of robots that does not depend on who was declared first.
bool NativeCollision::precedes(std::uint32_t a, std::uint32_t b) const {
  return robots_[a].key != robots_[b].key ? robots_[a].key < robots_[b].key : a < b;
}

/// False: there is nothing but planes to touch, and nothing has been done.
bool NativeCollision::touch_pairs(std::uint32_t robot, const Neighbours::Of& near_it) {
  thread_local Encounters encounters;
  const RobotColliders& own = index_->robots[robot];
  encounters.start(own.bounds);
  std::size_t plane = 0;
  const auto add_planes_before = [&](std::uint32_t collider) {
    for (; plane < planes_.size() && planes_[plane] < collider; ++plane)
      encounters.add_other(scenery_[planes_[plane]], false, false);
  };
  for (const std::uint32_t k : near_it.scenery) {
    if (!scenery_[k].bounds.overlaps(own.bounds)) continue;
    add_planes_before(k);
    encounters.add_other(scenery_[k], false, false);
  }
  add_planes_before(std::numeric_limits<std::uint32_t>::max());
  add_mates(encounters, robot, near_it);
  if (!robots_have_planes_ && encounters.others() == planes_.size()) return false;
  for (std::uint32_t k = own.first; k < own.first + own.count; ++k) encounters.add_own(near(k));
  robots_[robot].list.clear();
  encounters.list_contacts(robots_[robot].list);
  for (int w = 0; w < words(own.count); ++w) robots_[robot].signature[w] = unknown;
  return true;
}

/// For a robot whose own world answers for the rest, or that no force moves.
void NativeCollision::touch_other_worlds(std::uint32_t robot, const Neighbours::Of& near_it) {
  thread_local Encounters encounters;
  const Robot& mine = robots_[robot];
  const RobotColliders& own = index_->robots[robot];
  if (!(*mine.list).empty()) mine.list.clear();
  for (int w = 0; w < words(own.count); ++w) mine.signature[w] = unknown;
  if (*mine.world == 0 || (near_it.mates.empty() && !robots_have_planes_)) return;
  encounters.start(own.bounds);
  add_mates(encounters, robot, near_it);
  if (encounters.others() == 0) return;
  for (std::uint32_t k = own.first; k < own.first + own.count; ++k) encounters.add_own(near(k));
  encounters.list_contacts(mine.list);
}

/// Whether contacts with `mate` belong into the list of `robot`: somebody asks for all, or the contact algorithm
/// answers for them.
bool NativeCollision::may_touch(std::uint32_t robot, std::uint32_t mate) const {
  if (robots_[mate].shadow_of >= 0 || robots_[robot].shadow_of == std::int32_t(mate)) return false;
  return robots_[robot].wants_all || is_listed(*robots_[robot].world, *robots_[mate].world);
}

/// Ordered by key. A plane reaches everyone.
void NativeCollision::add_mates(Encounters& encounters, std::uint32_t robot, const Neighbours::Of& near_it) const {
  thread_local std::vector<std::uint32_t> mates;
  mates.clear();
  if (!robots_have_planes_) {
    for (const std::uint32_t m : near_it.mates)
      if (index_->robots[m].bounds.overlaps(encounters.bounds()) && may_touch(robot, m)) mates.push_back(m);
  } else {
    for (std::uint32_t m = 0; m < robots_.size(); ++m)
      if (m != robot && may_touch(robot, m) &&
          (robots_[robot].has_plane || robots_[m].has_plane || index_->robots[m].bounds.overlaps(encounters.bounds())))
        mates.push_back(m);
  }
  std::sort(mates.begin(), mates.end(), [this](std::uint32_t a, std::uint32_t b) { return precedes(a, b); });
  for (const std::uint32_t m : mates) add_mate(encounters, robot, m);
}

void NativeCollision::add_mate(Encounters& encounters, std::uint32_t robot, std::uint32_t mate) const {
  const RobotColliders& theirs = index_->robots[mate];
  for (std::uint32_t k = theirs.first; k < theirs.first + theirs.count; ++k) {
    if (!robots_[robot].has_plane && !ball(k).overlaps(encounters.bounds())) continue;
    const Near other = near(k);
    if (robots_[robot].has_plane || other.bounds.overlaps(encounters.bounds()))
      encounters.add_other(other, precedes(mate, robot),
                           robots_[mate].list && (robots_[mate].wants_all || *robots_[mate].world != 0));
  }
}

}  // namespace muro::native
