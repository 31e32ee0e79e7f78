// SPDX-License-Identifier: MIT
#include "native_collision.hpp"

#include <algorithm>
#include <bit>
#include <cstddef>

#include "hulls/hull_plane.hpp"
#include "pairs/collide.hpp"
#include "pairs/separation_bound.hpp"
#include "plugins/common/lanes/prefetch.hpp"
#include "terrain/collide_terrain.hpp"

namespace muro::native {

namespace {

/// Value of a signature that no set of points has.
constexpr double unknown = -1;
constexpr int batch_size = 8;

// the layout that GroundBatch::contacts relies on
static_assert(offsetof(Contact, normal) == offsetof(Contact, point) + normal_number * sizeof(double));
static_assert(offsetof(Contact, depth) == offsetof(Contact, point) + depth_number * sizeof(double));
static_assert(sizeof(Contact) % sizeof(double) == 0);

/// Returns the number of points of the next slot that touch.
int points_of(const KernelShape& shape, const double* signature, SignatureCursor& cursor) {
  cursor.begin(shape);
  int points = 0;
  if (shape.kind == KernelShapeKind::mesh)
    for (int w = 0; w < SignatureCursor::words_of(shape); ++w)
      points += std::popcount(std::uint64_t(signature[cursor.word() + w]));
  else
    points = std::popcount(std::uint64_t(signature[cursor.word()]) >> (8 * cursor.slot()) & 0xff);
  cursor.end(shape);
  return points;
}

}  // namespace

/// Robots of a group that are processed together.
struct NativeCollision::Batch {
  GroundBatch ground;
  std::uint32_t robots[batch_size];
  Contact* found[batch_size];  ///< contacts that the kernel writes for each robot
  unsigned merged = 0;         ///< one bit for each robot that touches more than the ground
};

void NativeCollision::connect(Connector& c) {
  kernels_ = &ground_kernels_for(lane::best_isa());
  PairCollision::connect(c);
  if (!is_needed()) return;
  meshes_.connect(c, c.parameters().text("meshes") == "exact");
  terrains_.connect(c);
}

void NativeCollision::start() {
  if (!is_needed()) return;
  meshes_.start(index_->colliders);
  add_kernel_shapes();
  PairCollision::start();
  add_grounds();
  group_robots();
  allocate_signatures();
  allocate_clearances();
}

/// Adds the shapes of all colliders. Shapes of robots also have the locations of their bodies' poses.
void NativeCollision::add_kernel_shapes() {
  shapes_.clear();
  for (const Collider& c : index_->colliders) {
    const bool first_of_robot = shapes_.empty() || (&c)[-1].robot != c.robot;
    const std::uint32_t body = first_of_robot ? 0 : shapes_.back().body + ((&c)[-1].body != c.body);
    shapes_.push_back(kernel_shape(std::uint32_t(shapes_.size()), body));
  }
  ground_robots_.assign(robots_.size(), {});
  for (const Collider& c : index_->colliders)
    if (c.robot != no_robot && c.body == robots_[index_of(c.robot)].base)
      ground_robots_[index_of(c.robot)].poses.base = lane::numbers(c.body_pose);
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    const Collider& c = index_->colliders[k];
    if (c.robot != no_robot)
      shapes_[k].pose = location_of(ground_robots_[index_of(c.robot)].poses, lane::numbers(c.body_pose));
  }
}

KernelShape NativeCollision::kernel_shape(std::uint32_t collider, std::uint32_t body) {
  const Shape& shape = *index_->colliders[collider].shape;
  if (shape.kind == ShapeKind::mesh) return meshes_.kernel_shape(collider, shape, body);
  const Aabb* const box = terrains_.box_of(shape);
  return box ? kernel_shape_of(shape, *box, body) : kernel_shape_of(shape, body);
}

void NativeCollision::add_grounds() {
  double radius = 0;
  for (const RobotColliders& r : index_->robots)
    for (std::uint32_t k = r.first; k < r.first + r.count; ++k)
      radius = std::max(radius, Vec3::Map(shapes_[k].half).sum());
  terrains_.start(index_->colliders, radius);
  ground_colliders_.clear();
  grounds_.clear();
  for (std::uint32_t k = 0; k < scenery_.size(); ++k) {
    const Terrain* const terrain = terrains_.of(k);
    if (!terrain && scenery_[k].shape.kind != ShapeKind::plane) continue;
    ground_colliders_.push_back(k);
    Ground& ground = grounds_.emplace_back();
    if (terrain)
      ground.terrain = &terrain->grid();
    else
      ground.plane = ground_plane_of(scenery_[k].shape);
  }
  has_grounds_of_one_object_ = false;
  for (std::size_t g = 1; g < ground_colliders_.size(); ++g) {
    const Collider &a = *scenery_[ground_colliders_[g - 1]].collider, &b = *scenery_[ground_colliders_[g]].collider;
    has_grounds_of_one_object_ |= a.body == b.body;
  }
}

void NativeCollision::group_robots() {
  groups_.clear();
  for (std::uint32_t r = 0; r < robots_.size(); ++r) {
    if (!robots_[r].list) continue;
    const RobotColliders& own = index_->robots[r];
    const auto first = shapes_.begin() + own.first;
    add_to_group(groups_, std::vector<KernelShape>(first, first + own.count), r);
  }
}

/// Allocates the signatures, and reserves room in the lists for all contacts that kernels may write.
void NativeCollision::allocate_signatures() {
  std::size_t all = 0;
  most_ground_points_ = 0;
  for (std::uint32_t r = 0; r < robots_.size(); ++r) {
    if (!robots_[r].list) continue;
    ground_robots_[r].words = signature_size(r);
    all += ground_robots_[r].words;
    const std::size_t most = max_ground_points * index_->robots[r].count * grounds_.size();
    most_ground_points_ = std::max(most_ground_points_, most);
    robots_[r].list.reserve(most);
    for (std::size_t i = 0; i < most; ++i) robots_[r].list.push_back({});
    robots_[r].list.clear();
  }
  signatures_.assign(all, unknown);
  double* next = signatures_.data();
  for (std::uint32_t r = 0; r < robots_.size(); ++r) {
    if (!robots_[r].list) continue;
    ground_robots_[r].signature = next;
    next += ground_robots_[r].words;
  }
}

void NativeCollision::allocate_clearances() {
  const auto numbers_of = [this](std::uint32_t robot) {
    const RobotColliders& own = index_->robots[robot];
    const int slots = clearances_of(shapes_.data() + own.first, int(own.count), grounds_.data(), int(grounds_.size()));
    return robots_[robot].list ? std::size_t(slots) * numbers_of_clearance : 0;
  };
  std::size_t all = 0;
  for (std::uint32_t r = 0; r < robots_.size(); ++r) all += numbers_of(r);
  clearances_.assign(all, 0);
  double* next = clearances_.data();
  for (std::uint32_t r = 0; r < robots_.size(); next += numbers_of(r++)) ground_robots_[r].clearances = next;
}

/// Returns the size in words.
std::size_t NativeCollision::signature_size(std::uint32_t robot) const {
  const RobotColliders& own = index_->robots[robot];
  return std::size_t(words_of(shapes_.data() + own.first, int(own.count), int(grounds_.size())));
}

TransformedShape NativeCollision::transformed_shape(std::uint32_t collider) const {
  return transformed(shapes_[collider], *index_->colliders[collider].body_pose);
}

void NativeCollision::collide(const TransformedCollider& a, const TransformedCollider& b,
                              std::vector<ContactPoint>& points) {
  if (b.shape.kind == ShapeKind::heightmap) {
    if (const Terrain* const terrain = terrains_.of(b.number)) collide_with_terrain(a, *terrain, points);
    return;
  }
  if (meshes_.any() && (a.shape.kind == ShapeKind::mesh || b.shape.kind == ShapeKind::mesh))
    return collide_meshes(a, b, points);
  Manifold manifold;
  collide_shapes(a.shape, b.shape, manifold);
  points.assign(manifold.points, manifold.points + manifold.count);
}

double NativeCollision::distance_bound(const TransformedCollider& a, const TransformedCollider& b) const {
  return separation_bound(a.shape, b.shape);
}

/// `is_left`: the kernel could not find the points.
void NativeCollision::collide_with_terrain(const TransformedCollider& a, const Terrain& terrain,
                                           std::vector<ContactPoint>& points, bool is_left) const {
  if (a.shape.kind != ShapeKind::mesh) return collide_terrain(a.shape, terrain, points, is_left);
  if (const MeshPairs::HullOf hull = meshes_.hull_of(a.number); hull.geometry)
    collide_terrain(a.shape, *hull.geometry, *hull.support, a.collider->pose(), terrain, points, is_left);
}

void NativeCollision::collide_meshes(const TransformedCollider& a, const TransformedCollider& b,
                                     std::vector<ContactPoint>& points) const {
  const auto on_plane = [&](const TransformedCollider& mesh, const TransformedCollider& plane) {
    add_hull_on_plane(shapes_[mesh.number], *mesh.collider->body_pose, plane.shape, points);
  };
  if (b.shape.kind == ShapeKind::plane) return on_plane(a, b);
  if (a.shape.kind != ShapeKind::plane) return meshes_.collide(a, b, points);
  on_plane(b, a);
  for (ContactPoint& p : points) p.normal = -p.normal;
}

void NativeCollision::list_contacts(Range robots) {
  thread_local std::vector<Contact> scratch;  // for lists with more than the kernel finds
  if (scratch.size() < batch_size * most_ground_points_) scratch.resize(batch_size * most_ground_points_);
  constexpr std::size_t near_cache = 256;  // robots whose data a near cache holds
  const bool is_large_team = robots_.size() > near_cache;
  Batch batch;
  GroundBatch& ground = batch.ground;
  ground.contact_stride = sizeof(Contact) / sizeof(double);
  ground.grounds = grounds_.data();
  ground.ground_count = int(grounds_.size());
  for (const auto& group : groups_) {
    ground.shapes = group.structure.data();
    ground.shape_count = int(group.structure.size());
    for (const std::uint32_t r : group.in(robots)) {
      if (!takes_kernel(r)) {
        list_pairs(r, candidates(r));
        std::fill_n(ground_robots_[r].signature, ground_robots_[r].words, unknown);
        continue;
      }
      const int i = ground.used++;
      batch.robots[i] = r;
      // the kernel finishes one ground of an object before the next; in lists the order is by shapes of a link first
      const bool is_merged = has_grounds_of_one_object_ || !touches_only_ground(r);
      batch.merged |= unsigned(is_merged) << i;
      ground.poses[i] = ground_robots_[r].poses;
      batch.found[i] = is_merged ? scratch.data() + std::size_t(i) * most_ground_points_ : (*robots_[r].list).data();
      ground.contacts[i] = batch.found[i]->point.data();
      ground.signatures[i] = ground_robots_[r].signature;
      ground.clearances[i] = ground_robots_[r].clearances;
      if (is_large_team) fetch(group.structure, ground.poses[i], *robots_[r].list);
      if (ground.used == batch_size) find_ground_contacts(batch);
    }
    if (ground.used > 0) find_ground_contacts(batch);
  }
}

/// Prefetches the poses that the kernel reads and the list that it writes, while other robots join the batch.
void NativeCollision::fetch(std::span<const KernelShape> shapes, const RobotPoses& poses,
                            std::span<const Contact> contacts) {
  for (const KernelShape& s : shapes) lane::prefetch_lines(s.pose.in(poses), sizeof(Pose));
  lane::prefetch_lines(contacts.data(), contacts.size_bytes());
}

/// Whether a kernel finds contacts of the robot with the ground.
bool NativeCollision::takes_kernel(std::uint32_t robot) const {
  return !grounds_.empty() && !robots_have_planes_ && lists_scenery(robots_[robot]);
}

/// Whether the robot touches nothing but planes and heightmaps of the scenery, according to bounds and its pairs with
/// robots.
bool NativeCollision::touches_only_ground(std::uint32_t robot) {
  const Aabb& bounds = index_->robots[robot].bounds;
  for (const std::uint32_t k : overlaps_.of(robot, *index_).scenery)
    if (scenery_[k].shape.kind != ShapeKind::heightmap && scenery_[k].bounds.overlaps(bounds)) return false;
  return !touches_robots(robot);
}

void NativeCollision::find_ground_contacts(Batch& batch) {
  thread_local std::vector<std::uint8_t> left;
  left.assign(std::size_t(slots_of(batch.ground.shape_count, batch.ground.ground_count)), 0);
  batch.ground.left = left.data();
  const unsigned found = kernels_->find_contacts(batch.ground), merged = batch.merged | found >> batch_size;
  for (unsigned changed = found & ~merged & ((1U << batch_size) - 1); changed != 0; changed &= changed - 1)
    list_ground_contacts(batch.robots[std::countr_zero(changed)]);
  for (unsigned rest = merged; rest != 0; rest &= rest - 1)
    list_merged(batch.robots[std::countr_zero(rest)], batch.found[std::countr_zero(rest)], left.data(), rest & -rest);
  batch.ground.used = 0;
  batch.merged = 0;
}

/// Calls `visit(own collider, ground, points)` for each slot of a robot, in their order.
template <class Visit>
void NativeCollision::each_slot(std::uint32_t robot, Visit visit) const {
  const double* const signature = ground_robots_[robot].signature;
  const RobotColliders& own = index_->robots[robot];
  const KernelShape* const shapes = shapes_.data() + own.first;
  SignatureCursor cursor;
  for (std::uint32_t begin = 0, end = 0; begin < own.count; begin = end) {
    while (end < own.count && shapes[end].body == shapes[begin].body) ++end;
    for (std::size_t g = 0; g < grounds_.size(); ++g)
      for (std::uint32_t k = begin; k < end; ++k)
        visit(own.first + k, g, std::size_t(points_of(shapes[k], signature, cursor)));
  }
}

/// Makes the list of a robot from its signature. Points, depths and the normals on heightmaps are already in place.
void NativeCollision::list_ground_contacts(std::uint32_t robot) const {
  const ListOut<Contact>& list = robots_[robot].list;
  Contact* next = (*list).data();
  list.clear();
  each_slot(robot, [&](std::uint32_t own, std::size_t ground, std::size_t points) {
    if (points == 0) return;
    Contact c = contact_between(index_->colliders[own], *scenery_[ground_colliders_[ground]].collider);
    c.normal = Vec3::Map(grounds_[ground].plane.normal);
    for (std::size_t n = 0; n < points; ++n, ++next) {
      c.point = next->point;
      if (grounds_[ground].terrain) c.normal = next->normal;
      c.depth = next->depth;
      list.push_back(c);
    }
  });
}

/// Makes the list of a robot from `found`, the contacts that the kernel has written, except for slots with its bit in
/// `left`. Those slots and all other pairs are collided pair by pair.
void NativeCollision::list_merged(std::uint32_t robot, Contact* found, const std::uint8_t* left, unsigned bit) {
  Candidates& candidates = this->candidates(robot);
  const bool is_in_list = found == (*robots_[robot].list).data();
  each_slot(robot, [&](std::uint32_t own, std::size_t ground, std::size_t points) {
    const TransformedCollider& other = scenery_[ground_colliders_[ground]];
    if (*left++ & bit) {
      collide_left(transformed_collider(own), other, candidates);
      found += points;
      return;
    }
    for (std::size_t n = 0; n < points; ++n, ++found) {
      if (!grounds_[ground].terrain) found->normal = Vec3::Map(grounds_[ground].plane.normal);
      if (is_in_list)
        add_found(own, other.number, {{{found->point, found->normal, found->depth}}}, candidates);
      else
        add_found(own, other.number, found->point.data(), candidates);
    }
  });
  add_other_scenery(robot, candidates);
  list_found(robot, candidates);
  std::fill_n(ground_robots_[robot].signature, ground_robots_[robot].words, unknown);
}

/// Collides a slot whose points the kernel could not find.
void NativeCollision::collide_left(const TransformedCollider& own, const TransformedCollider& ground,
                                   Candidates& candidates) {
  if (!own.bounds.overlaps(ground.bounds)) return;
  candidates.points.clear();
  if (const Terrain* const terrain = terrains_.of(ground.number))
    collide_with_terrain(own, *terrain, candidates.points, true);
  else
    collide(own, ground, candidates.points);
  add_found(own.number, ground.number, candidates.points, candidates);
}

/// Adds contacts with scenery that is neither a plane nor a heightmap.
void NativeCollision::add_other_scenery(std::uint32_t robot, Candidates& candidates) {
  const auto is_ground = [this](const TransformedCollider* c) {
    return c->shape.kind == ShapeKind::plane || terrains_.of(c->number) != nullptr;
  };
  if (std::all_of(candidates.others.begin(), candidates.others.end(), is_ground)) return;
  const RobotColliders& own = index_->robots[robot];
  for (std::uint32_t k = own.first; k < own.first + own.count; ++k) {
    const TransformedCollider collider = transformed_collider(k);
    for (const TransformedCollider* const other : candidates.others) {
      if (is_ground(other) || !collider.bounds.overlaps(other->bounds)) continue;
      candidates.points.clear();
      collide(collider, *other, candidates.points);
      add_found(k, other->number, candidates.points, candidates);
    }
  }
}

}  // namespace muro::native
