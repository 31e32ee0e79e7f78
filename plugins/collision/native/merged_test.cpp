// SPDX-License-Identifier: MIT
// Robots whose contacts come in part from the SIMD kernel and in part pair by pair.
#include <gtest/gtest.h>

#include "muro/toolkit/heightmap.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/collision_scene.hpp"
#include "tests/support/files.hpp"
#include "tests/support/randoms.hpp"

namespace muro {
namespace {

using test::CollisionScene, test::Randoms, test::ScratchFolder;

/// A heightmap of 12 m by 12 m as scenery: hills, with bumps of up to `bumps` (m).
void add_hills(test::Scene& scene, const ScratchFolder& folder, double spacing, double bumps) {
  const auto nodes = std::uint32_t(std::lround(12 / spacing)) + 1;
  std::vector<float> values(std::size_t(nodes) * nodes);
  const Heightmap map{values, nodes, nodes, {12, 12, 1}};
  Randoms random(3);
  for (std::uint32_t r = 0; r < nodes; ++r)
    for (std::uint32_t c = 0; c < nodes; ++c) {
      const Vec3 p = map.node(c, r);
      values[std::size_t(r) * nodes + c] =
          float(0.3 * std::sin(0.7 * p.x()) * std::cos(0.6 * p.y()) + random.uniform(0, bumps));
    }
  Shape ground{.kind = ShapeKind::heightmap, .size = {12, 12, 1}};
  ground.mesh = scene.world().intern(folder.file(
      "hills.r32", std::string(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(float))));
  scene.world().add_scenery("hills", {}, std::span(&ground, 1));
}

/// A box on two wheels and a ball; with `mesh` a hull in place of the box.
RobotTree cart(const std::string& mesh = "") {
  return test::tree_of([&](RobotBuilder& b) {
    const Shape chassis[] = {mesh.empty() ? Shape::box({0.4, 0.3, 0.1}) : test::mesh_shape(b, mesh)},
                wheel[] = {Shape::cylinder(0.1, 0.06)}, ball[] = {Shape::sphere(0.1)};
    b.base("body");
    b.set(keys::inertial, test::unit_inertia);
    b.set_array(keys::collision_shapes, std::span<const Shape>(chassis));
    for (const double y : {0.2, -0.2}) {
      b.fork();
      b.translation({0.1, y, 0});
      b.rotation(from_rpy(M_PI / 2, 0, 0));
      b.body(y > 0 ? "left" : "right");
      b.set_array(keys::collision_shapes, std::span<const Shape>(wheel));
      b.end();
    }
    b.translation({-0.15, 0, 0});
    b.body("caster");
    b.set_array(keys::collision_shapes, std::span<const Shape>(ball));
    b.end();
    b.end();
  });
}

constexpr const char* grounds[] = {"plane", "hills", "rocks"};

void add_ground_of(test::Scene& scene, const ScratchFolder& folder, std::string_view ground) {
  if (ground == "plane") scene.add_ground();
  if (ground == "hills") add_hills(scene, folder, 0.5, 0);
  if (ground == "rocks") add_hills(scene, folder, 0.2, 0.05);
}

/// Carts at those `poses` whose bit is set in `which`.
struct Carts : CollisionScene {
  std::vector<const RobotView*> all;

  Carts(std::string_view ground, const ScratchFolder& folder, std::span<const Pose> poses, std::uint64_t which) {
    add_ground_of(*this, folder, ground);
    add_scenery("wall", Shape::box({0.2, 3, 1}), {{1, 0, 0.3}, Quat::Identity()});
    for (std::size_t i = 0; i < poses.size(); ++i)
      if (which >> i & 1) all.push_back(&add_dynamic("cart" + std::to_string(i), cart(), poses[i]));
    finish_setup();
    step_once();
  }
};

/// Two balls on one link, in the corner of one object of two planes, optionally with a post in the box around both.
struct Corner : CollisionScene {
  const RobotView* robot = nullptr;

  explicit Corner(bool post) {
    Shape planes[] = {Shape::plane(), Shape::plane()};
    planes[1].origin.orientation = from_rpy(0, M_PI / 2, 0);
    world().add_scenery("corner", {}, std::span<const Shape>(planes));
    if (post) add_scenery("post", Shape::box({0.02, 0.02, 0.02}), {{0.3, 0.3, 0.25}, Quat::Identity()});
    robot = &add_dynamic("balls", test::tree_of([](RobotBuilder& b) {
                           Shape balls[] = {Shape::sphere(0.1), Shape::sphere(0.1)};
                           balls[1].origin.position = {0, 0.6, 0};
                           b.base("body");
                           b.set(keys::inertial, test::unit_inertia);
                           b.set_array(keys::collision_shapes, std::span<const Shape>(balls));
                         }),
                         {{0.09, 0, 0.09}, Quat::Identity()});
    finish_setup();
    step_once();
  }
};

TEST(CollisionNativeMerged, GroundsOfOneObjectAreInOneOrderWhateverIsNear) {
  Corner alone(false), beside(true);
  const std::span<const Contact> a = alone.world().values(alone.robot->base(), keys::contacts),
                                 b = beside.world().values(beside.robot->base(), keys::contacts);
  ASSERT_EQ(a.size(), 4u);
  ASSERT_EQ(b.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    EXPECT_EQ(a[i].self_shape, b[i].self_shape) << i;
    EXPECT_EQ(a[i].other_shape, b[i].other_shape) << i;
    EXPECT_EQ(a[i].point, b[i].point) << i;
  }
}

TEST(CollisionNativeMerged, ARobotInACrowdKeepsTheContactsThatItHasAlone) {
  const ScratchFolder folder;
  Randoms random(6);
  for (const char* const ground : grounds) {
    std::vector<Pose> poses;
    for (int i = 0; i < 20; ++i)
      poses.push_back({{random.uniform(-0.9, 0.9), random.uniform(-0.9, 0.9), random.uniform(0.05, 0.15)},
                       from_rpy(random.uniform(-0.1, 0.1), random.uniform(-0.1, 0.1), random.uniform(-3, 3))});
    Carts crowd(ground, folder, poses, (1U << 20) - 1);
    World& world = crowd.world();
    int on_ground = 0, with_wall = 0, mixed = 0;
    for (std::size_t i = 0; i < poses.size(); ++i) {
      Carts alone(ground, folder, poses, 1U << i);
      const auto expected = alone.contacts(*alone.all[0]), all = crowd.contacts(*crowd.all[i]);
      std::vector<Contact> found;
      for (std::size_t k = 0; k < all.size(); ++k) {
        const bool is_of_scenery = world.robot_of(all[k].other) == no_robot;
        if (is_of_scenery) found.push_back(all[k]);
        if (k == 0 || all[k].self != all[k - 1].self) continue;
        EXPECT_TRUE(world.robot_of(all[k - 1].other) == no_robot || !is_of_scenery) << "scenery comes before robots";
      }
      mixed += !found.empty() && found.size() < all.size();
      ASSERT_EQ(found.size(), expected.size()) << ground << ", " << i;
      for (std::size_t k = 0; k < found.size(); ++k) {
        EXPECT_EQ(world.object_name(found[k].self), alone.world().object_name(expected[k].self));
        EXPECT_EQ(world.object_name(found[k].other), alone.world().object_name(expected[k].other));
        EXPECT_EQ(found[k].point, expected[k].point);
        EXPECT_EQ(found[k].normal, expected[k].normal);
        EXPECT_EQ(found[k].depth, expected[k].depth);
        const bool is_of_wall = world.object_name(found[k].other) == "wall";
        ++(is_of_wall ? with_wall : on_ground);
      }
    }
    EXPECT_GT(on_ground, 30) << ground;
    EXPECT_GT(with_wall, 5) << ground;
    EXPECT_GT(mixed, 5) << ground;
  }
}

TEST(CollisionNativeMerged, StepsOnHillsAndInCrowdsAllocateNothingOnceWarm) {
#if defined(__SANITIZE_ADDRESS__) || defined(__SANITIZE_THREAD__)
  ASSERT_EQ(test::allocations(), 0u) << "sanitizers count allocations themselves";
#else
  const ScratchFolder folder;
  const std::string mesh = folder.file("wedge.obj", test::wedge);
  for (const char* const ground : grounds) {
    CollisionScene scene;
    add_ground_of(scene, folder, ground);
    const RobotTree carts[] = {cart(), cart(mesh)};
    const Shape bodies[] = {Shape::box({1.3, 0.9, 0.2}), Shape::capsule(0.1, 0.2), Shape::cylinder(0.1, 0.2)};
    std::vector<const RobotView*> all;
    for (int i = 0; i < 24; ++i)
      all.push_back(i % 4 < 2 ? &scene.add_dynamic("r" + std::to_string(i), carts[i % 4], {})
                              : &scene.add_dynamic("r" + std::to_string(i), bodies[i % 3], {}));
    scene.finish_setup();
    std::uint64_t in_steps = 0;
    std::size_t most_contacts = 0;
    for (int round = 0; round < 2; ++round) {
      Randoms random(11);
      in_steps = 0;
      for (int step = 0; step < 60; ++step) {
        for (const RobotView* r : all) {
          scene.pose(*r) = {{random.uniform(-4, 4), random.uniform(-4, 4), random.uniform(-0.2, 0.4)},
                            from_rpy(random.uniform(-0.3, 0.3), random.uniform(-0.3, 0.3), random.uniform(-3, 3))};
          scene.twist(*r) = {};
        }
        const std::uint64_t before = test::allocations();
        scene.step_once();
        in_steps += test::allocations() - before;
        for (const RobotView* r : all) most_contacts = std::max(most_contacts, scene.contacts(*r).size());
      }
    }
    EXPECT_EQ(in_steps, 0u) << ground << ", the second time";
    EXPECT_GT(most_contacts, 20u) << ground;
  }
#endif
}

}  // namespace
}  // namespace muro
