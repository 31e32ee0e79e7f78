// SPDX-License-Identifier: MIT
// Plugin collision_native: the spatial index and exact collision detection of primitive shapes.
#include <algorithm>
#include <cmath>
#include <tuple>
#include <vector>

#include "muro/plugin.hpp"
#include "pairs/collide.hpp"
#include "scene_bvh.hpp"

namespace {

using namespace muro;
using namespace muro::native;

constexpr Use reads[] = {{"scene.index", "shapes and their places"}};
constexpr Use writes[] = {{"contacts", "list on the base of every robot that forces move"}};
constexpr Description description{
    .id = "collision.native",
    .kind = Kind::collision,
    .version = "1.0.0",
    .summary =
        "Contact points between boxes, spheres, cylinders, capsules and planes, in closed form where there is one",
    .parameters = {},
    .reads = reads,
    .writes = writes,
    .promises = deterministic | allocation_free | restorable,
};

/// Order matters: a list is sorted by bodies and shapes, so that it depends on the state alone and not on the
/// tree that was searched. A pair of robots is worked out once, for the lower number, and mirrored.
class NativeCollision final : public Algorithm {
 public:
  void connect(Connector& c) override {
    bool any = false;
    for (const RobotView* r : c.robots()) {
      const bool dynamic = c.is_used(r->base(), keys::external_wrench, Access::read_sum);
      lists_.push_back(dynamic ? c.derived_list(r->base(), keys::contacts) : ListOut<Contact>{});
      any = any || dynamic;
    }
    if (any) index_ = c.read(world_object, keys::scene_index);
  }

  void step(const Step&, Range) override {
    for (const ListOut<Contact>& list : lists_)
      if (list) list.clear();
    for (std::uint32_t r = 0; r < lists_.size(); ++r)
      if (lists_[r]) touch_everything(r);
    for (const ListOut<Contact>& list : lists_)
      if (list) sort(*list);
  }

 private:
  void touch_everything(std::uint32_t r) {
    const SceneIndex& scene = *index_;
    const RobotColliders& robot = scene.robots[r];
    own_.clear();
    for (std::uint32_t k = robot.first; k < robot.first + robot.count; ++k)
      own_.push_back(placed(*scene.colliders[k].shape, scene.colliders[k].pose()));
    for (const std::uint32_t p : scene.planes) {
      const Collider& plane = scene.colliders[p];
      if (plane.robot == std::int32_t(r) || !reaches(robot.bounds, plane)) continue;
      const Placed ground = placed(*plane.shape, plane.pose());
      for (std::uint32_t k = 0; k < robot.count; ++k) touch(scene.colliders[robot.first + k], own_[k], plane, ground);
    }
    each_near(scene.scenery, robot.bounds, [&](std::uint32_t other) {
      if (scene.colliders[other].bounds().overlaps(robot.bounds)) touch_collider(robot, scene.colliders[other]);
    });
    each_near(scene.moving, robot.bounds, [&](std::uint32_t other) {
      const RobotColliders& mate = scene.robots[other];
      if (other == r || (other < r && lists_[other]) || !mate.bounds.overlaps(robot.bounds)) return;
      for (std::uint32_t k = mate.first; k < mate.first + mate.count; ++k)
        if (scene.colliders[k].bounds().overlaps(robot.bounds)) touch_collider(robot, scene.colliders[k]);
    });
  }

  /// Whether a box goes below the plane.
  static bool reaches(const Aabb& box, const Collider& plane) {
    const Vec3 normal = plane.pose().orientation * Vec3::UnitZ();
    const Vec3 middle = 0.5 * (box.low + box.high), half = 0.5 * (box.high - box.low);
    return normal.dot(middle - plane.pose().position) < normal.cwiseAbs().dot(half);
  }

  void touch_collider(const RobotColliders& robot, const Collider& other) {
    Placed second;
    bool known = false;
    for (std::uint32_t k = 0; k < robot.count; ++k) {
      const Collider& own = index_->colliders[robot.first + k];
      if (own.shape->kind == ShapeKind::plane || !own.bounds().overlaps(other.bounds())) continue;
      if (!known) second = placed(*other.shape, other.pose());
      known = true;
      touch(own, own_[k], other, second);
    }
  }

  void touch(const Collider& own, const Placed& first, const Collider& other, const Placed& second) {
    Manifold manifold;
    collide(first, second, manifold);
    if (manifold.count == 0) return;
    Contact c;
    c.self = own.body;
    c.other = other.body;
    c.self_shape = own.shape_index;
    c.other_shape = other.shape_index;
    c.friction = std::sqrt(own.shape->friction * other.shape->friction);
    c.restitution = std::max(own.shape->restitution, other.shape->restitution);
    const ListOut<Contact>& mine = lists_[std::size_t(own.robot)];
    const ListOut<Contact> theirs = other.robot >= 0 ? lists_[std::size_t(other.robot)] : ListOut<Contact>{};
    for (int i = 0; i < manifold.count; ++i) {
      c.point = manifold.points[i].point;
      c.normal = manifold.points[i].normal;
      c.depth = manifold.points[i].depth;
      mine.push_back(c);
      if (theirs) theirs.push_back(mirrored(c));
    }
  }

  static Contact mirrored(Contact c) {
    std::swap(c.self, c.other);
    std::swap(c.self_shape, c.other_shape);
    c.normal = -c.normal;
    return c;
  }

  /// By bodies, then shapes; points of one pair keep their order. Lists are short and nearly sorted.
  static void sort(std::span<Contact> list) {
    const auto key = [](const Contact& c) { return std::tuple(c.self, c.other, c.self_shape, c.other_shape); };
    for (std::size_t i = 1; i < list.size(); ++i) {
      if (!(key(list[i]) < key(list[i - 1]))) continue;
      const Contact moved = list[i];
      std::size_t k = i;
      for (; k > 0 && key(moved) < key(list[k - 1]); --k) list[k] = list[k - 1];
      list[k] = moved;
    }
  }

  In<SceneIndex> index_;
  std::vector<Placed> own_;              ///< the colliders of the robot that is being worked on
  std::vector<ListOut<Contact>> lists_;  ///< by robot number; empty handles for robots that forces do not move
};

constexpr abi::AlgorithmEntry algorithms[] = {algorithm<SceneBvh>(scene_bvh_description),
                                              algorithm<NativeCollision>(description)};

}  // namespace

MURO_PLUGIN(.name = "collision_native", .version = "1.0.0", .licence = "MIT",
            .summary = "Spatial index and collision detection of primitive shapes", .algorithms = algorithms)
