// SPDX-License-Identifier: MIT
// scene.bvh in a simulation.
#include <gtest/gtest.h>

#include "muro/base/bounds.hpp"
#include "muro/toolkit/rotations.hpp"
#include "tests/support/collision_scene.hpp"
#include "tests/support/files.hpp"

namespace muro {
namespace {

using test::CollisionScene, test::Crowd, test::mesh_shape, test::meshed_body, test::wedge;

/// Returns half the extent of a shape along each axis of the world.
Vec3 reach_of(const Shape& s, const Quat& turn) {
  const Mat3 axes = turn.toRotationMatrix();
  const Vec3 up = axes.col(2).cwiseAbs();
  switch (s.kind) {
    case ShapeKind::sphere:
      return Vec3::Constant(s.size.x());
    case ShapeKind::capsule:
      return Vec3::Constant(s.size.x()) + 0.5 * s.size.z() * up;
    case ShapeKind::cylinder:
      return s.size.x() * (1 - up.array().square()).sqrt().matrix() + 0.5 * s.size.z() * up;
    default:
      return axes.cwiseAbs() * 0.5 * s.size;
  }
}

TEST(SceneBvh, DescribesTheSceneOfTheInstant) {
  Crowd crowd(0.1);
  for (int instant = 0; instant < 10; ++instant) {
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < crowd.all.size(); ++i) poses.push_back(crowd.place());
    crowd.put(poses);
    crowd.step_once();
    const SceneIndex& index = crowd.world().value(world_object, keys::scene_index);
    ASSERT_EQ(index.colliders.size(), 21 + crowd.all.size());
    ASSERT_EQ(index.robots.size(), crowd.all.size());
    ASSERT_EQ(index.planes.size(), 1u);
    EXPECT_EQ(index.colliders[index.planes[0]].body, crowd.world().object("ground"));
    for (std::size_t r = 0; r < poses.size(); ++r) {
      ASSERT_EQ(index.robots[r].count, 1u);
      const Collider& c = index.colliders[index.robots[r].first];
      EXPECT_EQ(c.robot, RobotId(std::uint32_t(r)));
      EXPECT_EQ(c.body, crowd.all[r]->base());
      EXPECT_EQ(c.pose().position, poses[r].position);
      const Aabb tight = bounds_of(*c.shape, poses[r]), present = bounds_of(*c.shape, c.pose());
      EXPECT_LT((present.low - tight.low).norm() + (present.high - tight.high).norm(), 1e-12);
      const Vec3 reach = reach_of(*c.shape, poses[r].orientation), slack = Vec3::Constant(1e-8);
      EXPECT_TRUE(index.robots[r].bounds.contains({poses[r].position - reach, poses[r].position + reach}));
      EXPECT_TRUE((Aabb{tight.low - slack, tight.high + slack}.contains(index.robots[r].bounds)));
      EXPECT_TRUE(index.robots[r].fat_aabb.contains(index.robots[r].bounds));
    }
    std::vector<int> seen(poses.size());
    for (const BvhNode& n : index.moving.nodes)
      for (std::uint32_t i = 0; i < n.count; ++i) {
        const std::uint32_t r = index.moving.items[n.first + i];
        ++seen[r];
        EXPECT_TRUE(n.bounds.contains(index.robots[r].bounds));
      }
    EXPECT_EQ(seen, std::vector<int>(poses.size(), 1));
    EXPECT_EQ(index.scenery.items.size(), 20u);
  }
}

TEST(SceneBvh, AFatAabbReachesFurtherToWhereItsRobotGoes) {
  CollisionScene scene;
  const RobotView& r = scene.add_dynamic("ball", Shape::sphere(0.2), {{0, 0, 5}, Quat::Identity()});
  scene.finish_setup();
  const SceneIndex& index = scene.world().value(world_object, keys::scene_index);
  const auto changes_on_the_way = [&](double metres) {
    const std::uint64_t before = index.changes[0];
    for (int i = 0; i < 1000; ++i) {
      scene.pose(r).position.x() += metres / 1000;
      scene.step_once();
    }
    return index.changes[0] - before;
  };
  EXPECT_EQ(changes_on_the_way(0), 0u);
  // 0.1 m ahead, and three quarters of the 0.1 m behind: each 25th or 26th step of 7 mm leaves the fat AABB
  EXPECT_NEAR(double(changes_on_the_way(7)), 39.5, 1);
  EXPECT_NEAR(double(changes_on_the_way(-7)), 39.5, 1);
}

TEST(SceneBvh, KnowsBoundsOfMeshes) {
  const test::ScratchFolder folder;
  CollisionScene scene;
  World& world = scene.world();
  const Shape rock = mesh_shape(world, folder.file("rock.obj", wedge));
  const Quat quarter = rotation_of({0, 0, M_PI / 2});
  world.add_scenery("rock", {{10, 0, 0}, quarter}, std::span<const Shape>(&rock, 1));
  const RobotView& r = scene.add_dynamic("rover", meshed_body(folder.path("rock.obj")), {{-5, 0, 1}, quarter});
  scene.finish_setup();
  scene.step_once();
  const SceneIndex& index = world.value(world_object, keys::scene_index);
  ASSERT_EQ(index.colliders.size(), 3u);
  ASSERT_EQ(index.scenery.nodes.size(), 1u);
  EXPECT_LT((index.scenery.nodes[0].bounds.low - Vec3(8, 0, 0)).norm(), 1e-6);
  EXPECT_LT((index.scenery.nodes[0].bounds.high - Vec3(10, 1, 4)).norm(), 1e-6);
  const Aabb& bounds = index.robots[index_of(r.id)].bounds;
  EXPECT_LT((bounds.low - Vec3(-7, -0.05, 0.95)).norm(), 1e-6) << bounds.low.transpose();
  EXPECT_LT((bounds.high - Vec3(-4.95, 1, 5)).norm(), 1e-6) << bounds.high.transpose();
  EXPECT_EQ(index.moving.items.size(), 1u);
}

TEST(SceneBvh, AMeshThatCannotBeReadIsAnError) {
  const test::ScratchFolder folder;
  for (const bool of_robot : {false, true}) {
    CollisionScene scene;
    const Shape missing = mesh_shape(scene.world(), folder.path("missing.obj"));
    if (of_robot)
      scene.add_dynamic("rover", meshed_body(folder.path("missing.obj")), {});
    else
      scene.add_dynamic("ball", Shape::sphere(0.3), {});
    if (!of_robot)
      for (const char* name : {"a", "b"}) scene.world().add_scenery(name, {}, std::span<const Shape>(&missing, 1));
    try {
      scene.finish_setup();
      ADD_FAILURE();
    } catch (const SetupError& e) {
      const std::string message = e.what(), body = of_robot ? "`rover/body`" : "`a`";
      EXPECT_NE(message.find("(scene.bvh) cannot be connected: " + body + ": mesh " + folder.path("missing.obj") +
                             " is not there; give the path of a DAE, STL, OBJ or glTF file"),
                message.npos)
          << message;
      EXPECT_EQ(message.find('\n'), message.npos) << message;
    }
  }
}

}  // namespace
}  // namespace muro
