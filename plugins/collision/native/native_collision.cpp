// SPDX-License-Identifier: MIT
#include "native_collision.hpp"

#include <bit>
#include <cstddef>

#include "mesh_warning.hpp"
#include "pairs/collide.hpp"

namespace muro::native {

namespace {

/// A signature that no set of points has.
constexpr double unknown = -1;
constexpr int batch_size = 8, points_per_slot = 8;

// the layout that GroundBatch::contacts relies on
static_assert(offsetof(Contact, depth) == offsetof(Contact, point) + depth_number * sizeof(double));
static_assert(sizeof(Contact) % sizeof(double) == 0);

}  // namespace

/// Robots of a group that are processed together.
struct NativeCollision::Batch {
  GroundBatch ground;
  std::uint32_t robots[batch_size];
};

void NativeCollision::connect(Connector& c) {
  kernels_ = &ground_kernels_for(lane::best_isa());
  PairCollision::connect(c);
  if (is_needed()) warn_of_meshes(c);
}

void NativeCollision::start() {
  if (!is_needed()) return;
  add_kernel_shapes();
  PairCollision::start();
  ground_planes_.clear();
  for (const std::uint32_t k : planes_) ground_planes_.push_back(ground_plane_of(scenery_[k].shape));
  group_robots();
  allocate_signatures();
}

/// Of all colliders; those of robots know their bodies' poses.
void NativeCollision::add_kernel_shapes() {
  shapes_.clear();
  for (const Collider& c : index_->colliders) {
    const bool first_of_robot = shapes_.empty() || (&c)[-1].robot != c.robot;
    const std::uint32_t body = first_of_robot ? 0 : shapes_.back().body + ((&c)[-1].body != c.body);
    shapes_.push_back(kernel_shape_of(*c.shape, body));
  }
  ground_robots_.assign(robots_.size(), {});
  for (const Collider& c : index_->colliders)
    if (c.robot >= 0 && c.body == robots_[std::size_t(c.robot)].base)
      ground_robots_[std::size_t(c.robot)].poses.base = lane::numbers(c.body_pose);
  for (std::size_t k = 0; k < shapes_.size(); ++k) {
    const Collider& c = index_->colliders[k];
    if (c.robot >= 0)
      shapes_[k].pose = location_of(ground_robots_[std::size_t(c.robot)].poses, lane::numbers(c.body_pose));
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

/// And capacity of the lists for all contacts that kernels may write.
void NativeCollision::allocate_signatures() {
  std::size_t all = 0;
  for (std::uint32_t r = 0; r < robots_.size(); ++r) {
    if (!robots_[r].list) continue;
    all += signature_size(r);
    const std::size_t most = points_per_slot * index_->robots[r].count * planes_.size();
    for (std::size_t i = 0; i < most; ++i) robots_[r].list.push_back({});
    robots_[r].list.clear();
  }
  signatures_.assign(all, unknown);
  double* next = signatures_.data();
  for (std::uint32_t r = 0; r < robots_.size(); ++r) {
    if (!robots_[r].list) continue;
    ground_robots_[r].signature = next;
    next += signature_size(r);
  }
}

/// In words.
std::size_t NativeCollision::signature_size(std::uint32_t robot) const {
  return std::size_t(words_of(int(index_->robots[robot].count), int(planes_.size())));
}

TransformedShape NativeCollision::transformed_shape(std::uint32_t collider) const {
  return transformed(shapes_[collider], *index_->colliders[collider].body_pose);
}

void NativeCollision::collide(const TransformedCollider& a, const TransformedCollider& b,
                              std::vector<ContactPoint>& points) {
  Manifold manifold;
  collide_shapes(a.shape, b.shape, manifold);
  points.assign(manifold.points, manifold.points + manifold.count);
}

void NativeCollision::list_contacts(Range robots) {
  Batch batch;
  GroundBatch& ground = batch.ground;
  ground.contact_stride = sizeof(Contact) / sizeof(double);
  ground.planes = ground_planes_.data();
  ground.plane_count = int(ground_planes_.size());
  for (const auto& group : groups_) {
    ground.shapes = group.structure.data();
    ground.shape_count = int(group.structure.size());
    ground.used = 0;
    for (const std::uint32_t r : group.in(robots)) {
      if (!touches_only_ground(r) && list_by_pairs(r)) continue;
      const int i = ground.used++;
      batch.robots[i] = r;
      ground.poses[i] = ground_robots_[r].poses;
      ground.contacts[i] = (*robots_[r].list).data()->point.data();
      ground.signatures[i] = ground_robots_[r].signature;
      if (ground.used == batch_size) find_ground_contacts(batch);
    }
    if (ground.used > 0) find_ground_contacts(batch);
  }
}

/// Whether the robot can touch nothing but the planes of the scenery, as far as bounds tell.
bool NativeCollision::touches_only_ground(std::uint32_t robot) {
  if (robots_have_planes_ || !lists_scenery(robots_[robot])) return false;
  const OverlapCache::Overlaps& overlaps = overlaps_.of(robot, *index_);
  if (overlaps.scenery.empty() && overlaps.robots.empty()) return true;
  const Aabb& bounds = index_->robots[robot].bounds;
  for (const std::uint32_t k : overlaps.scenery)
    if (scenery_[k].bounds.overlaps(bounds)) return false;
  for (const std::uint32_t r : overlaps.robots)
    if (index_->robots[r].bounds.overlaps(bounds)) return false;
  return true;
}

/// False: there is nothing but planes of the scenery to touch, and nothing has been done.
bool NativeCollision::list_by_pairs(std::uint32_t robot) {
  Candidates& found = candidates(robot);
  if (!robots_have_planes_ && lists_scenery(robots_[robot]) && found.others.size() == planes_.size()) return false;
  list_pairs(robot, found);
  std::fill_n(ground_robots_[robot].signature, signature_size(robot), unknown);
  return true;
}

void NativeCollision::find_ground_contacts(Batch& batch) const {
  for (unsigned changed = kernels_->find_contacts(batch.ground); changed != 0; changed &= changed - 1)
    list_ground_contacts(batch.robots[std::countr_zero(changed)]);
  batch.ground.used = 0;
}

/// Makes the list of a robot from its signature: the points and depths are in their places already.
void NativeCollision::list_ground_contacts(std::uint32_t robot) const {
  const ListOut<Contact>& list = robots_[robot].list;
  const double* const signature = ground_robots_[robot].signature;
  Contact* const contacts = (*list).data();
  const RobotColliders& own = index_->robots[robot];
  const KernelShape* const shapes = shapes_.data() + own.first;
  list.clear();
  std::size_t slot = 0, written = 0;
  for (std::uint32_t begin = 0, end = 0; begin < own.count; begin = end) {
    while (end < own.count && shapes[end].body == shapes[begin].body) ++end;
    for (std::size_t p = 0; p < planes_.size(); ++p)
      for (std::uint32_t k = begin; k < end; ++k, ++slot) {
        const double word = signature[slot / slots_per_word];
        const auto points = unsigned(std::uint64_t(word) >> (8 * (slot % slots_per_word)) & 0xff);
        if (points == 0) continue;
        Contact c = contact_between(index_->colliders[own.first + k], *scenery_[planes_[p]].collider);
        c.normal = Vec3::Map(ground_planes_[p].normal);
        for (int n = std::popcount(points); n > 0; --n, ++written) {
          c.point = contacts[written].point;
          c.depth = contacts[written].depth;
          list.push_back(c);
        }
      }
  }
}

}  // namespace muro::native
