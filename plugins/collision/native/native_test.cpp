// SPDX-License-Identifier: MIT
// collision.native in a simulation.
#include <gtest/gtest.h>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/collision_scene.hpp"
#include "tests/support/files.hpp"
#include "tests/support/randoms.hpp"

namespace muro {
namespace {

using test::CollisionScene, test::Crowd, test::Randoms, test::mesh_shape, test::meshed_body, test::wedge,
    test::unit_inertia;

void expect_equal(const Contact& a, const Contact& b) {
  EXPECT_EQ(a.self, b.self);
  EXPECT_EQ(a.other, b.other);
  EXPECT_EQ(a.self_shape, b.self_shape);
  EXPECT_EQ(a.other_shape, b.other_shape);
  EXPECT_EQ(a.point, b.point);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.depth, b.depth);
}

TEST(CollisionNative, ListsTheCornersOfABoxOnTheGround) {
  CollisionScene scene;
  scene.add_ground(0.9);
  Shape box = Shape::box({1, 1, 1});
  box.surface.friction = 0.4;
  box.surface.restitution = 0.3;
  const RobotView& r = scene.add_dynamic("crate", box, {{3, 4, 0.49}, Quat::Identity()});
  scene.finish_setup();
  scene.step_once();
  const auto contacts = scene.contacts(r);
  ASSERT_EQ(contacts.size(), 4u);
  Vec3 middle = Vec3::Zero();
  for (const Contact& c : contacts) {
    EXPECT_EQ(c.self, r.base());
    EXPECT_EQ(c.other, scene.world().object("ground"));
    EXPECT_NEAR(c.depth, 0.01, 1e-12);
    EXPECT_EQ(c.normal, Vec3(0, 0, 1));
    EXPECT_DOUBLE_EQ(c.surface.friction, 0.4);
    EXPECT_DOUBLE_EQ(c.surface.restitution, 0.3);
    middle += c.point / 4;
  }
  EXPECT_LT((middle - Vec3(3, 4, -0.005)).norm(), 1e-12);
}

TEST(CollisionNative, APairOfRobotsStandsInBothListsWithOppositeNormals) {
  CollisionScene scene;
  const RobotView& a = scene.add_dynamic("a", Shape::box({1, 1, 1}), {{0, 0, 0}, from_rpy(0.1, 0.2, 0.3)});
  const RobotView& b = scene.add_dynamic("b", Shape::cylinder(0.5, 1), {{0.9, 0.1, 0}, from_rpy(1, 0.2, 0)});
  scene.finish_setup();
  scene.step_once();
  const auto first = scene.contacts(a), second = scene.contacts(b);
  ASSERT_GT(first.size(), 0u);
  ASSERT_EQ(second.size(), first.size());
  for (std::size_t i = 0; i < first.size(); ++i) {
    Contact mirrored = second[i];
    std::swap(mirrored.self, mirrored.other);
    std::swap(mirrored.self_shape, mirrored.other_shape);
    mirrored.normal = -mirrored.normal;
    expect_equal(mirrored, first[i]);
    EXPECT_LT(first[i].normal.x(), 0);
  }
}

TEST(CollisionNative, AKinematicRobotIsAnObstacleWhoeverComesFirst) {
  for (const bool first : {true, false}) {
    CollisionScene scene;
    const Pose beside{{0.95, 0, 0}, Quat::Identity()};
    if (first) scene.add_kinematic("cart", Shape::sphere(0.5), beside);
    const RobotView& r = scene.add_dynamic("ball", Shape::sphere(0.5), {});
    if (!first) scene.add_kinematic("cart", Shape::sphere(0.5), beside);
    scene.finish_setup();
    scene.step_once();
    const auto contacts = scene.contacts(r);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_EQ(contacts[0].other, scene.world().find_robot("cart")->base());
    EXPECT_NEAR(contacts[0].depth, 0.05, 1e-12);
    EXPECT_LT((contacts[0].normal - Vec3(-1, 0, 0)).norm(), 1e-12);
  }
}

TEST(CollisionNative, ShapesOfOneRobotDoNotTouchEachOther) {
  const Shape shapes[] = {Shape::box({1, 1, 1}), Shape::sphere(0.6)};
  CollisionScene scene;
  const RobotView& r = scene.add_dynamic("double", test::tree_of([&](RobotBuilder& b) {
                                           b.base("body");
                                           b.set(keys::inertial, unit_inertia);
                                           b.set_array(keys::collision_shapes, std::span<const Shape>(shapes));
                                           b.translation({0.2, 0, 0});
                                           b.body("head");
                                           b.set_array(keys::collision_shapes, std::span<const Shape>(shapes));
                                         }),
                                         {});
  const Shape wall = Shape::box({1, 9, 9});
  scene.world().add_scenery("wall", {{1.15, 0, 0}, Quat::Identity()}, std::span<const Shape>(&wall, 1));
  scene.finish_setup();
  scene.step_once();
  const auto contacts = scene.contacts(r);
  std::map<std::pair<ObjectId, std::uint32_t>, int> points;
  for (const Contact& c : contacts) {
    EXPECT_EQ(c.other, scene.world().object("wall"));
    ++points[{c.self, c.self_shape}];
  }
  const ObjectId body = scene.world().object("double/body"), head = scene.world().object("double/head");
  EXPECT_EQ(points[std::pair(head, 0u)], 4);  // face at 0.7 against the wall at 0.65
  EXPECT_EQ(points[std::pair(head, 1u)], 1);  // sphere to 0.8
  EXPECT_EQ(points.count(std::pair(body, 0u)) + points.count(std::pair(body, 1u)), 0u);
}

TEST(CollisionNative, ContactsDependOnThePosesAloneAndNotOnWhatWasBefore) {
  Crowd travelled(0.1), wide(5), none(0);
  for (int instant = 0; instant < 12; ++instant) {
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < travelled.all.size(); ++i) poses.push_back(travelled.place());
    Crowd fresh(0.1);
    std::vector<std::vector<Contact>> results;
    for (Crowd* crowd : {&travelled, &wide, &none, &fresh}) {
      crowd->put(poses);
      crowd->step_once();
      results.push_back(crowd->every_contact());
    }
    ASSERT_GT(results[0].size(), 50u);
    for (const auto& result : results) {
      ASSERT_EQ(result.size(), results[0].size());
      for (std::size_t i = 0; i < result.size(); ++i) expect_equal(result[i], results[0][i]);
    }
  }
}

TEST(CollisionNative, ListsAreSortedAndFreeOfDoubles) {
  Crowd crowd(0.1);
  std::vector<Pose> poses;
  for (std::size_t i = 0; i < crowd.all.size(); ++i) poses.push_back(crowd.place());
  crowd.put(poses);
  crowd.step_once();
  World& world = crowd.world();
  const auto pair_of = [&](const Contact& c) {  // scenery as declared, then robots by their keys
    const RobotId other_robot = world.robot_of(c.other);
    const std::uint64_t key = other_robot == no_robot ? 0 : world.robots()[index_of(other_robot)]->key;
    return std::tuple(c.self, other_robot != no_robot, key, c.other, c.self_shape, c.other_shape);
  };
  for (std::size_t r = 0; r < crowd.all.size(); ++r) {
    if (r % 5 == 4) continue;
    const auto list = crowd.contacts(*crowd.all[r]);
    for (std::size_t i = 1; i < list.size(); ++i) {
      EXPECT_LE(pair_of(list[i - 1]), pair_of(list[i]));
      for (std::size_t k = 0; k < i; ++k)
        if (pair_of(list[i]) == pair_of(list[k])) {
          EXPECT_NE(list[i].point, list[k].point);
        }
    }
  }
}

TEST(CollisionNative, MeshesTouchLikeOtherShapesWithoutAWord) {
  const test::ScratchFolder folder;
  const std::string file = folder.file("rock.obj", wedge);
  CollisionScene scene;
  std::string warnings;
  scene.set_log([&](LogLevel level, std::string_view text) {
    if (level == LogLevel::warning) warnings += text;
  });
  const Shape shapes[] = {mesh_shape(scene.world(), file), Shape::box({1, 1, 1})};
  scene.world().add_scenery("rock", {}, std::span<const Shape>(shapes));
  const RobotView& r = scene.add_dynamic("ball", Shape::sphere(0.2), {{-0.1, 1, 1}, Quat::Identity()});
  const RobotView& meshed = scene.add_dynamic("meshed", meshed_body(file), {{-0.9, 1.9, 3.9}, Quat::Identity()});
  scene.finish_setup();
  scene.step_once();
  EXPECT_EQ(warnings, "");
  const auto contacts = scene.contacts(r);
  ASSERT_EQ(contacts.size(), 1u);
  EXPECT_EQ(contacts[0].other_shape, 0u);
  EXPECT_NEAR(contacts[0].depth, 0.1, 1e-9);
  EXPECT_LT((contacts[0].normal - Vec3(-1, 0, 0)).norm(), 1e-9);
  ASSERT_GT(scene.contacts(meshed).size(), 0u);
  for (const Contact& c : scene.contacts(meshed)) {
    EXPECT_EQ(c.self_shape, 0u);
    EXPECT_EQ(c.other_shape, 0u);
    EXPECT_LT(c.depth, 0.1 + 1e-6);
  }
}

TEST(CollisionNative, AFlatMeshCollidesAsItIsAndAsAPlateWithPlanes) {
  const test::ScratchFolder folder;
  const std::string file = folder.file("sheet.obj", "v -1 -1 0\nv 1 -1 0\nv 1 1 0\nv -1 1 0\nf 1 2 3 4\n");
  CollisionScene scene;
  scene.add_scenery("sheet", mesh_shape(scene.world(), file), {});
  scene.add_ground(0.8, {{0, 0, -5}, Quat::Identity()});
  const RobotView& r = scene.add_dynamic("ball", Shape::sphere(0.2), {{0.3, 0.1, 0.19}, Quat::Identity()});
  const RobotView& sheet = scene.add_dynamic("flat", meshed_body(file), {{0, 0, -5.001}, Quat::Identity()});
  scene.finish_setup();
  scene.step_once();
  ASSERT_EQ(scene.contacts(r).size(), 1u);
  EXPECT_NEAR(scene.contacts(r)[0].depth, 0.01, 1e-9);
  EXPECT_LT((scene.contacts(r)[0].normal - Vec3::UnitZ()).norm(), 1e-9);
  const auto touching = scene.contacts(sheet);
  const auto of_the_sheet = std::count_if(touching.begin(), touching.end(), [](const Contact& c) {
    return c.self_shape == 0 && std::abs(c.depth - 1e-3 - 0.5e-3 * std::sqrt(8)) < 1e-6;  // half the plate's thickness
  });
  EXPECT_EQ(of_the_sheet, 4);
}

/// Robots of hulls and of primitives in a heap on the ground.
struct Heap : CollisionScene {
  std::vector<const RobotView*> all;
  std::vector<Pose> places;

  Heap(const std::string& file, bool backwards, unsigned threads) {
    set_threads(threads);
    add_ground();
    Randoms random(4);
    for (int i = 0; i < 24; ++i)
      places.push_back({{random.uniform(-2, 2), random.uniform(-2, 2), random.uniform(-0.5, 0.5)}, random.rotation()});
    for (int k = 0; k < 24; ++k) {
      const int i = backwards ? 23 - k : k;
      const std::string name = "r" + std::to_string(i);
      all.push_back(i % 2 == 0 ? &add_dynamic(name, meshed_body(file), places[std::size_t(i)])
                               : &add_dynamic(name, Shape::box({0.6, 0.5, 0.4}), places[std::size_t(i)]));
    }
    if (backwards) std::reverse(all.begin(), all.end());
    finish_setup();
    step_once();
  }
};

TEST(CollisionNative, HullsInAHeapHaveEqualContactsInAnyOrderAndOnAllThreads) {
  const test::ScratchFolder folder;
  const std::string file = folder.file("rock.obj", wedge);
  Heap heap(file, false, 1), other(file, true, 3);
  std::size_t of_robots = 0;
  for (std::size_t i = 0; i < heap.all.size(); ++i) {
    const auto ours = heap.contacts(*heap.all[i]), theirs = other.contacts(*other.all[i]);
    ASSERT_EQ(ours.size(), theirs.size());
    for (std::size_t k = 0; k < ours.size(); ++k) {
      EXPECT_EQ(ours[k].point, theirs[k].point);
      EXPECT_EQ(ours[k].normal, theirs[k].normal);
      EXPECT_EQ(ours[k].depth, theirs[k].depth);
      EXPECT_EQ(heap.world().object_name(ours[k].other), other.world().object_name(theirs[k].other));
      of_robots += heap.world().robot_of(ours[k].other) != no_robot;
    }
  }
  EXPECT_GT(of_robots, 50u);
}

/// Two robots without gravity, each a box with a capsule beside it.
struct Dumbbells : CollisionScene {
  const RobotView *a, *b;

  Dumbbells(const Pose& at_a, const Pose& at_b) {
    const Shape box[] = {Shape::box({0.4, 0.2, 0.3})}, capsule[] = {Shape::capsule(0.1, 0.3)};
    const RobotTree tree = test::tree_of([&](RobotBuilder& builder) {
      builder.base("body");
      builder.set(keys::inertial, unit_inertia);
      builder.set_array(keys::collision_shapes, std::span<const Shape>(box));
      builder.translation({0.1, 0.3, 0});
      builder.body("arm");
      builder.set_array(keys::collision_shapes, std::span<const Shape>(capsule));
    });
    a = &add_dynamic("a", tree, at_a);
    b = &add_dynamic("b", tree, at_b);
    finish_setup();
  }
};

TEST(CollisionNative, RobotsThatWereApartAreSeenToTouchAtOnceHoweverTheyMove) {
  Randoms random(8);
  Pose at_a{{0, 0, 0}, random.rotation()}, at_b{{0.6, 0.1, 0}, random.rotation()};
  Dumbbells followed(at_a, at_b);
  int touching = 0, changes = 0;
  double phase = 0;
  for (int i = 0; i < 400; ++i) {
    // fast, slow, slower and at rest, for some steps each
    const double speed = i / 40 % 4 == 3 ? 0 : 0.4 * std::pow(0.1, i / 40 % 4);
    phase += speed;
    at_b.position.x() = 0.55 + 0.3 * std::sin(phase);
    for (Pose* p : {&at_a, &at_b}) {
      p->orientation = p->orientation * Quat(Eigen::AngleAxisd(0.1 * speed, random.direction()));
      p->orientation.normalize();
    }
    followed.pose(*followed.a) = at_a, followed.pose(*followed.b) = at_b;
    followed.twist(*followed.a) = followed.twist(*followed.b) = {};
    followed.step_once();
    Dumbbells fresh(at_a, at_b);
    fresh.step_once();
    const auto seen = followed.contacts(*followed.a), expected = fresh.contacts(*fresh.a);
    ASSERT_EQ(seen.size(), expected.size()) << i;
    for (std::size_t k = 0; k < seen.size(); ++k) expect_equal(seen[k], expected[k]);
    changes += (touching > 0) != !seen.empty();
    touching = int(seen.size());
  }
  EXPECT_GT(changes, 5);
}

TEST(CollisionNative, SaysNothingOfAMeshThatEndsTheSetUp) {
  const test::ScratchFolder folder;
  CollisionScene scene;
  std::string warnings;
  scene.set_log([&](LogLevel level, std::string_view text) {
    if (level == LogLevel::warning) warnings += text;
  });
  scene.add_dynamic("meshed", meshed_body(folder.path("missing.obj")), {});
  EXPECT_THROW(scene.finish_setup(), SetupError);
  EXPECT_EQ(warnings, "");
}

}  // namespace
}  // namespace muro
