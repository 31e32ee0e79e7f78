// SPDX-License-Identifier: MIT
// scene.bvh and collision.native in a simulation.
#include <gtest/gtest.h>

#include <map>
#include <random>

#include "tests/support/bodies.hpp"
#include "tests/support/files.hpp"

namespace muro {
namespace {

using test::Scene;

const Inertia unit_inertia = Inertia::from(1, Vec3::Zero(), 0.1 * Mat3::Identity());

/// Robots of level 2 (moved by forces) or level 0 (moved by commands), and the contacts of one instant.
struct Touching : Scene {
  std::map<std::string, ParameterInput> scene_parameters;

  Touching() { world().set(world_object, keys::gravity, Vec3(0, 0, 0)); }

  const RobotView& add_dynamic(const std::string& name, const RobotTree& tree, const Pose& start) {
    const RobotView& r = add(name, tree, start);
    use("motion.simplified", 100, {{&r, r.base()}});
    return r;
  }
  const RobotView& add_dynamic(const std::string& name, const Shape& shape, const Pose& start) {
    return add_dynamic(name, test::single_body(shape, unit_inertia), start);
  }
  const RobotView& add_kinematic(const std::string& name, const Shape& shape, const Pose& start) {
    const RobotView& r = add(name, test::single_body(shape, unit_inertia), start);
    use("motion.point", 100, {{&r, r.base()}});
    return r;
  }
  void finish_setup() {
    use_kinematics();
    use("scene.bvh", 0, {}, scene_parameters);
    use("collision.native", 100);
    build();
  }
  /// One instant; afterwards `contacts` are those of the poses before it.
  void instant() { run_for(0.01); }
  std::vector<Contact> contacts(const RobotView& r) {
    const std::span<Contact> list = world().values(r.base(), keys::contacts);
    return {list.begin(), list.end()};
  }
};

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
  Touching scene;
  scene.add_ground(0.9);
  Shape box = Shape::box({1, 1, 1});
  box.friction = 0.4;
  box.restitution = 0.3;
  const RobotView& r = scene.add_dynamic("crate", box, {{3, 4, 0.49}, Quat::Identity()});
  scene.finish_setup();
  scene.instant();
  const auto contacts = scene.contacts(r);
  ASSERT_EQ(contacts.size(), 4u);
  Vec3 middle = Vec3::Zero();
  for (const Contact& c : contacts) {
    EXPECT_EQ(c.self, r.base());
    EXPECT_EQ(c.other, scene.world().object("ground"));
    EXPECT_NEAR(c.depth, 0.01, 1e-12);
    EXPECT_EQ(c.normal, Vec3(0, 0, 1));
    EXPECT_DOUBLE_EQ(c.friction, std::sqrt(0.9 * 0.4));
    EXPECT_DOUBLE_EQ(c.restitution, 0.3);
    middle += c.point / 4;
  }
  EXPECT_LT((middle - Vec3(3, 4, -0.005)).norm(), 1e-12);
}

TEST(CollisionNative, APairOfRobotsStandsInBothListsWithOppositeNormals) {
  Touching scene;
  const RobotView& a = scene.add_dynamic("a", Shape::box({1, 1, 1}), {{0, 0, 0}, from_rpy(0.1, 0.2, 0.3)});
  const RobotView& b = scene.add_dynamic("b", Shape::cylinder(0.5, 1), {{0.9, 0.1, 0}, from_rpy(1, 0.2, 0)});
  scene.finish_setup();
  scene.instant();
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
    Touching scene;
    const Pose beside{{0.95, 0, 0}, Quat::Identity()};
    if (first) scene.add_kinematic("cart", Shape::sphere(0.5), beside);
    const RobotView& r = scene.add_dynamic("ball", Shape::sphere(0.5), {});
    if (!first) scene.add_kinematic("cart", Shape::sphere(0.5), beside);
    scene.finish_setup();
    scene.instant();
    const auto contacts = scene.contacts(r);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_EQ(contacts[0].other, scene.world().find_robot("cart")->base());
    EXPECT_NEAR(contacts[0].depth, 0.05, 1e-12);
    EXPECT_LT((contacts[0].normal - Vec3(-1, 0, 0)).norm(), 1e-12);
  }
}

TEST(CollisionNative, ShapesOfOneRobotDoNotTouchEachOther) {
  const Shape shapes[] = {Shape::box({1, 1, 1}), Shape::sphere(0.6)};
  Touching scene;
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
  scene.instant();
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

/// A crowd on a field with obstacles, and random places for it.
struct Crowd : Touching {
  std::vector<const RobotView*> all;
  std::mt19937_64 engine;

  explicit Crowd(double margin, unsigned seed = 1) : engine(seed) {
    scene_parameters = {{"margin", margin}};
    add_ground();
    for (int i = 0; i < 20; ++i) {
      const Shape shapes[] = {Shape::box({0.5, 1, 2}), Shape::cylinder(0.4, 1)};
      world().add_scenery("obstacle" + std::to_string(i), place(), std::span<const Shape>(&shapes[i % 2], 1));
    }
    const Shape kinds[] = {Shape::box({1, 0.6, 0.4}), Shape::sphere(0.4), Shape::cylinder(0.4, 0.6),
                           Shape::capsule(0.3, 0.6)};
    for (int i = 0; i < 24; ++i) {
      const std::string name = "r" + std::to_string(i);
      all.push_back(i % 5 == 4 ? &add_kinematic(name, kinds[i % 4], {}) : &add_dynamic(name, kinds[i % 4], {}));
    }
    finish_setup();
  }
  Pose place() {
    std::uniform_real_distribution<double> at(-2.5, 2.5), up(0, 0.5), angle(-3, 3);
    return {{at(engine), at(engine), up(engine)}, from_rpy(angle(engine), angle(engine), angle(engine))};
  }
  void put(std::span<const Pose> poses) {
    for (std::size_t i = 0; i < all.size(); ++i) {
      pose(*all[i]) = poses[i];
      twist(*all[i]) = {};
    }
  }
  std::vector<Contact> every_contact() {
    std::vector<Contact> contacts_of_all;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (i % 5 != 4)
        for (const Contact& c : contacts(*all[i])) contacts_of_all.push_back(c);
    return contacts_of_all;
  }
};

TEST(CollisionNative, ContactsDependOnThePosesAloneAndNotOnWhatWasBefore) {
  Crowd travelled(0.1), wide(5), none(0);
  for (int instant = 0; instant < 12; ++instant) {
    std::vector<Pose> poses;
    for (std::size_t i = 0; i < travelled.all.size(); ++i) poses.push_back(travelled.place());
    Crowd fresh(0.1);
    std::vector<std::vector<Contact>> results;
    for (Crowd* crowd : {&travelled, &wide, &none, &fresh}) {
      crowd->put(poses);
      crowd->instant();
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
  crowd.instant();
  World& world = crowd.world();
  const auto pair_of = [&](const Contact& c) {  // scenery as declared, then robots by their keys
    const std::int32_t mate = world.robot_of(c.other);
    const std::uint64_t key = mate < 0 ? 0 : world.robots()[std::size_t(mate)]->key;
    return std::tuple(c.self, mate >= 0, key, c.other, c.self_shape, c.other_shape);
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

/// How far a shape reaches along each axis of the world.
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
    crowd.instant();
    const SceneIndex& index = crowd.world().value(world_object, keys::scene_index);
    ASSERT_EQ(index.colliders.size(), 21 + crowd.all.size());
    ASSERT_EQ(index.robots.size(), crowd.all.size());
    ASSERT_EQ(index.planes.size(), 1u);
    EXPECT_EQ(index.colliders[index.planes[0]].body, crowd.world().object("ground"));
    for (std::size_t r = 0; r < poses.size(); ++r) {
      ASSERT_EQ(index.robots[r].count, 1u);
      const Collider& c = index.colliders[index.robots[r].first];
      EXPECT_EQ(c.robot, std::int32_t(r));
      EXPECT_EQ(c.body, crowd.all[r]->base());
      EXPECT_EQ(c.pose().position, poses[r].position);
      const Aabb tight = bounds_of(*c.shape, poses[r]);
      EXPECT_LT((c.bounds().low - tight.low).norm() + (c.bounds().high - tight.high).norm(), 1e-12);
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

TEST(SceneBvh, ARoomReachesFurtherToWhereItsRobotGoes) {
  Touching scene;
  const RobotView& r = scene.add_dynamic("ball", Shape::sphere(0.2), {{0, 0, 5}, Quat::Identity()});
  scene.finish_setup();
  const SceneIndex& index = scene.world().value(world_object, keys::scene_index);
  const auto changes_on_the_way = [&](double metres) {
    const std::uint64_t before = index.changes[0];
    for (int i = 0; i < 1000; ++i) {
      scene.pose(r).position.x() += metres / 1000;
      scene.instant();
    }
    return index.changes[0] - before;
  };
  EXPECT_EQ(changes_on_the_way(0), 0u);
  // 0.1 m and three quarters of that on the other side: left with each 25th or 26th step of 7 mm
  EXPECT_NEAR(double(changes_on_the_way(7)), 39.5, 1);
  EXPECT_NEAR(double(changes_on_the_way(-7)), 39.5, 1);
}

/// A wedge: half of the box from (0, 0, 0) to (1, 2, 4).
const char* const wedge =
    "v 0 0 0\nv 1 0 0\nv 0 2 0\nv 0 0 4\nv 1 0 4\nv 0 2 4\n"
    "f 1 3 2\nf 4 5 6\nf 1 2 5 4\nf 2 3 6 5\nf 3 1 4 6\n";

template <class Interns>
Shape mesh_shape(Interns& texts, const std::string& file) {
  Shape mesh{.kind = ShapeKind::mesh, .size = {1, 1, 1}};
  mesh.mesh = texts.intern(file);
  return mesh;
}

/// One body with a mesh and a box around its origin.
RobotTree meshed_body(const std::string& file) {
  return test::tree_of([&](RobotBuilder& b) {
    const Shape shapes[] = {mesh_shape(b, file), Shape::box({0.1, 0.1, 0.1})};
    b.base("body");
    b.set(keys::inertial, unit_inertia);
    b.set_array(keys::collision_shapes, std::span<const Shape>(shapes));
  });
}

TEST(CollisionNative, WarnsOfEachMeshFileOnceAndTouchesTheOtherShapes) {
  const test::ScratchFolder folder;
  for (const std::string& file : {folder.file("rock.obj", wedge), folder.path("missing.obj")}) {
    Touching scene;
    std::vector<std::string> lines;
    scene.set_log([&](LogLevel level, std::string_view text) {
      if (level == LogLevel::warning && text.find("collision.native") != text.npos) lines.emplace_back(text);
    });
    const Shape shapes[] = {mesh_shape(scene.world(), file), Shape::box({1, 1, 1})};
    for (const char* name : {"rock1", "rock2"}) scene.world().add_scenery(name, {}, std::span<const Shape>(shapes));
    const RobotView& r = scene.add_dynamic("ball", Shape::sphere(0.2), {{0.6, 0, 0}, Quat::Identity()});
    const RobotView& meshed = scene.add_dynamic("meshed", meshed_body(file), {{0, 0.5, 0}, Quat::Identity()});
    scene.finish_setup();
    scene.instant();
    ASSERT_EQ(lines.size(), 1u);
    EXPECT_NE(lines[0].find(file), std::string::npos) << lines[0];
    const auto contacts = scene.contacts(r);
    ASSERT_EQ(contacts.size(), 2u);
    for (const Contact& c : contacts) EXPECT_EQ(c.other_shape, 1u);
    ASSERT_GT(scene.contacts(meshed).size(), 0u);
    for (const Contact& c : scene.contacts(meshed)) EXPECT_NE(c.self_shape, 0u);
  }
}

TEST(SceneBvh, KnowsTheBoundsOfMeshesAndWarnsOnceOfOneThatCannotBeRead) {
  const test::ScratchFolder folder;
  Touching scene;
  std::vector<std::string> lines;
  scene.set_log([&](LogLevel level, std::string_view text) {
    if (level == LogLevel::warning && text.find("scene.bvh") != text.npos) lines.emplace_back(text);
  });
  World& world = scene.world();
  const Shape rock = mesh_shape(world, folder.file("rock.obj", wedge)),
              missing = mesh_shape(world, folder.path("missing.obj"));
  const Quat quarter = rotation_of({0, 0, M_PI / 2});
  world.add_scenery("rock", {{10, 0, 0}, quarter}, std::span<const Shape>(&rock, 1));
  for (const char* name : {"a", "b"}) world.add_scenery(name, {}, std::span<const Shape>(&missing, 1));
  const RobotView& r = scene.add_dynamic("rover", meshed_body(folder.path("rock.obj")), {{-5, 0, 1}, quarter});
  scene.finish_setup();
  scene.instant();
  ASSERT_EQ(lines.size(), 1u);
  EXPECT_NE(lines[0].find("missing.obj is not there"), std::string::npos) << lines[0];
  const SceneIndex& index = world.value(world_object, keys::scene_index);
  ASSERT_EQ(index.colliders.size(), 3u);
  ASSERT_EQ(index.scenery.nodes.size(), 1u);
  EXPECT_LT((index.scenery.nodes[0].bounds.low - Vec3(8, 0, 0)).norm(), 1e-6);
  EXPECT_LT((index.scenery.nodes[0].bounds.high - Vec3(10, 1, 4)).norm(), 1e-6);
  const Aabb& bounds = index.robots[r.number].bounds;
  EXPECT_LT((bounds.low - Vec3(-7, -0.05, 0.95)).norm(), 1e-6) << bounds.low.transpose();
  EXPECT_LT((bounds.high - Vec3(-4.95, 1, 5)).norm(), 1e-6) << bounds.high.transpose();
  EXPECT_EQ(index.moving.items.size(), 1u);
}

}  // namespace
}  // namespace muro
