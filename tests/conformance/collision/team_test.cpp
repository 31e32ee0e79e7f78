// SPDX-License-Identifier: MIT
// Promises of every collision algorithm for a team: contacts depend only on poses, and on which robot they belong to.
#include <random>

#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/collision/touching.hpp"
#include "tests/support/allocation_counter.hpp"

namespace muro {
namespace {

using test::CollisionScene;

struct EveryCollisionOfATeam : ::testing::TestWithParam<std::string> {};

void expect_equal(const Contact& a, const Contact& b) {
  EXPECT_EQ(a.point, b.point);
  EXPECT_EQ(a.normal, b.normal);
  EXPECT_EQ(a.depth, b.depth);
  EXPECT_EQ(a.self_shape, b.self_shape);
  EXPECT_EQ(a.other_shape, b.other_shape);
}

/// Robots of all kinds on a field with obstacles, so close that they touch.
struct Crowd : CollisionScene {
  std::vector<const RobotView*> all;  ///< by name
  std::vector<bool> moved_by_forces;

  /// `order[i]`: number of the robot that is declared as the i-th.
  Crowd(const std::string& collision, const std::vector<int>& order, unsigned threads = 1) : CollisionScene(collision) {
    all.resize(order.size());
    moved_by_forces.resize(order.size());
    std::mt19937_64 engine(5);
    std::uniform_real_distribution<double> at(-2, 2), up(0, 0.6), angle(-3, 3);
    const auto place = [&] {
      const Vec3 position(at(engine), at(engine), up(engine));
      return Pose{position, from_rpy(angle(engine), angle(engine), angle(engine))};
    };
    add_ground();
    const Shape obstacles[] = {Shape::box({0.5, 1, 2}), Shape::cylinder(0.4, 1)};
    for (int i = 0; i < 12; ++i) add_scenery("obstacle" + std::to_string(i), obstacles[i % 2], place());
    std::vector<Pose> places;
    for (std::size_t i = 0; i < order.size(); ++i) places.push_back(place());
    const Shape kinds[] = {Shape::box({1, 0.6, 0.4}), Shape::sphere(0.4), Shape::cylinder(0.4, 0.6),
                           Shape::capsule(0.3, 0.6)};
    for (const int i : order) {
      const auto n = std::size_t(i);
      const std::string name = "r" + std::to_string(i);
      moved_by_forces[n] = i % 5 != 4;
      all[n] = moved_by_forces[n] ? &add_dynamic(name, kinds[i % 4], places[n])
                                  : &add_kinematic(name, kinds[i % 4], places[n]);
    }
    finish_setup();
    set_threads(threads);
  }
  std::vector<Contact> every_contact() {
    std::vector<Contact> list;
    for (std::size_t i = 0; i < all.size(); ++i)
      if (moved_by_forces[i])
        for (const Contact& c : contacts(*all[i])) list.push_back(c);
    return list;
  }
};

std::vector<int> in_order(int count) {
  std::vector<int> order;
  for (int i = 0; i < count; ++i) order.push_back(i);
  return order;
}

TEST_P(EveryCollisionOfATeam, APairOfRobotsStandsInBothListsWithOppositeNormals) {
  Crowd crowd(GetParam(), in_order(24));
  crowd.step_once();
  int pairs = 0;
  for (std::size_t i = 0; i < crowd.all.size(); ++i) {
    if (!crowd.moved_by_forces[i]) continue;
    for (std::size_t k = 0; k < crowd.all.size(); ++k) {
      if (k == i || !crowd.moved_by_forces[k]) continue;
      std::vector<Contact> ours, theirs;
      for (const Contact& c : crowd.contacts(*crowd.all[i]))
        if (c.other == crowd.all[k]->base()) ours.push_back(c);
      for (const Contact& c : crowd.contacts(*crowd.all[k]))
        if (c.other == crowd.all[i]->base()) theirs.push_back(c);
      ASSERT_EQ(ours.size(), theirs.size());
      pairs += !ours.empty();
      for (std::size_t c = 0; c < ours.size(); ++c) {
        theirs[c].normal = -theirs[c].normal;
        expect_equal(ours[c], theirs[c]);
        EXPECT_GT(ours[c].depth, 0);
        EXPECT_NEAR(ours[c].normal.norm(), 1, 1e-9);
      }
    }
  }
  EXPECT_GT(pairs, 20);
}

TEST_P(EveryCollisionOfATeam, NeitherOrderOfDeclarationNorNumberOfThreadsChangesABit) {
  std::vector<int> order = in_order(24);
  Crowd crowd(GetParam(), order);
  std::reverse(order.begin(), order.end());
  std::swap(order[3], order[11]);
  Crowd other(GetParam(), order, 3);
  for (int instant = 0; instant < 5; ++instant) {
    crowd.step_once();
    other.step_once();
    const std::vector<Contact> ours = crowd.every_contact(), theirs = other.every_contact();
    ASSERT_EQ(ours.size(), theirs.size());
    ASSERT_GT(ours.size(), 50u);
    for (std::size_t i = 0; i < ours.size(); ++i) expect_equal(ours[i], theirs[i]);
  }
}

TEST_P(EveryCollisionOfATeam, ListsAreSortedByOwnAndOtherBodyAndShape) {
  Crowd crowd(GetParam(), in_order(24));
  crowd.step_once();
  World& world = crowd.world();
  const auto pair_of = [&](const Contact& c) {  // scenery as declared, then robots by their keys
    const RobotId other_robot = world.robot_of(c.other);
    const std::uint64_t key = other_robot == no_robot ? 0 : world.robots()[index_of(other_robot)]->key;
    return std::tuple(c.self, other_robot != no_robot, key, c.other, c.self_shape, c.other_shape);
  };
  for (std::size_t i = 0; i < crowd.all.size(); ++i) {
    if (!crowd.moved_by_forces[i]) continue;
    const auto list = crowd.contacts(*crowd.all[i]);
    EXPECT_TRUE(std::is_sorted(list.begin(), list.end(),
                               [&](const Contact& a, const Contact& b) { return pair_of(a) < pair_of(b); }));
  }
}

TEST_P(EveryCollisionOfATeam, AMotionThatCommandsMoveIsAnObstacleAndHasNoList) {
  for (const bool first : {true, false}) {
    CollisionScene scene(GetParam());
    const Pose beside{{0.95, 0, 0}, Quat::Identity()};
    if (first) scene.add_kinematic("cart", Shape::sphere(0.5), beside);
    const RobotView& r = scene.add_dynamic("ball", Shape::sphere(0.5), {});
    if (!first) scene.add_kinematic("cart", Shape::sphere(0.5), beside);
    scene.finish_setup();
    scene.step_once();
    const auto contacts = scene.contacts(r);
    ASSERT_EQ(contacts.size(), 1u);
    EXPECT_EQ(contacts[0].other, scene.world().find_robot("cart")->base());
    EXPECT_NEAR(contacts[0].depth, 0.05, 1e-9);
    EXPECT_LT((contacts[0].normal - Vec3(-1, 0, 0)).norm(), 1e-9);
  }
}

TEST_P(EveryCollisionOfATeam, ListsAPairOnlyWhereTheContactAlgorithmAnswersForIt) {
  CollisionScene scene(GetParam());
  scene.add_ground();
  const Shape ball = Shape::sphere(0.5);
  const RobotView& a = scene.add_dynamic("a", ball, {{0, 0, 0.45}, Quat::Identity()});
  const RobotView& b = scene.add_dynamic("b", ball, {{0.9, 0, 0.45}, Quat::Identity()});
  const RobotView& cart = scene.add_kinematic("cart", ball, {{0, 0.9, 0.45}, Quat::Identity()});
  scene.finish_setup();
  const ObjectId ground = scene.world().object("ground");
  const auto listed = [&](const RobotView& r, std::uint64_t world_a, std::uint64_t world_b) {
    scene.world().value(a.base(), keys::contact_world) = world_a;
    scene.world().value(b.base(), keys::contact_world) = world_b;
    scene.step_once();
    std::vector<ObjectId> others;
    for (const Contact& c : scene.contacts(r)) others.push_back(c.other);
    return others;
  };
  using Others = std::vector<ObjectId>;
  const auto sorted = [](Others o) {
    std::sort(o.begin(), o.end());
    return o;
  };
  EXPECT_EQ(sorted(listed(a, 1, 1)), sorted({ground, b.base(), cart.base()}));
  EXPECT_EQ(sorted(listed(b, 1, 1)), sorted({ground, a.base()}));
  EXPECT_EQ(listed(a, 7, 1), Others{b.base()}) << "a world of its own answers for scenery and what commands move";
  EXPECT_EQ(sorted(listed(b, 7, 1)), sorted({ground, a.base()}));
  EXPECT_EQ(listed(a, 7, 8), Others{b.base()}) << "of two worlds neither answers for the other's";
  EXPECT_EQ(listed(b, 7, 8), Others{a.base()});
  EXPECT_EQ(listed(a, 7, 7), Others{}) << "one world";
  EXPECT_EQ(listed(a, 0, 1), Others{}) << "no force moves it";
  EXPECT_EQ(sorted(listed(b, 0, 1)), sorted({ground, a.base()}));
  EXPECT_EQ(listed(a, 7, 0), Others{});
}

TEST_P(EveryCollisionOfATeam, GoesOnFromASnapshotToTheSameBits) {
  Crowd crowd(GetParam(), in_order(24));
  crowd.run_for(0.05);
  const Snapshot snapshot = crowd.snapshot();
  crowd.run_for(0.05);
  const std::vector<Contact> first = crowd.every_contact();
  crowd.restore(snapshot);
  crowd.run_for(0.05);
  const std::vector<Contact> second = crowd.every_contact();
  ASSERT_EQ(first.size(), second.size());
  for (std::size_t i = 0; i < first.size(); ++i) expect_equal(first[i], second[i]);
}

struct EveryAllocationFreeCollision : EveryCollisionOfATeam {};

TEST_P(EveryAllocationFreeCollision, AllocatesNothingOnceWarm) {
  Crowd crowd(GetParam(), in_order(24));
  crowd.run_for(0.2);
  const std::uint64_t before = test::allocations();
  crowd.run_for(0.2);
  EXPECT_EQ(test::allocations() - before, 0u);
}

/// Robot of one link with gravity on a floor that is a box, pushed by contact.penalty.
struct Standing : test::Scene {
  const RobotView* robot;

  Standing(const std::string& collision, const Shape& shape, const Shape& floor, double height) {
    world().add_scenery("floor", {{0, 0, -0.5 * floor.size.z()}, Quat::Identity()}, std::span<const Shape>(&floor, 1));
    robot = &add("robot", test::single_body(shape, test::unit_inertia), {{0.3, -0.2, height}, from_rpy(0, 0, 0.3)});
    use("motion.simplified", 1000, {{robot, robot->base()}});
    use_kinematics();
    use("scene.bvh", 0);
    use(collision, 0);
    use("contact.penalty", 0);
    build();
  }
};

TEST_P(EveryCollisionOfATeam, BoxAndCylinderStandStillOnABox) {
  const Shape floor = Shape::box({4, 4, 1});
  const std::tuple<const char*, Shape, double> cases[] = {{"box", Shape::box({0.4, 0.3, 0.5}), 0.25},
                                                          {"cylinder", Shape::cylinder(0.2, 0.5), 0.25}};
  for (const auto& [name, shape, height] : cases) {
    Standing scene(GetParam(), shape, floor, height);
    scene.run_for(1);
    const Pose settled = scene.pose(*scene.robot);
    EXPECT_NEAR(settled.position.z(), height, 1e-3) << name;
    scene.run_for(4);
    const Pose end = scene.pose(*scene.robot);
    EXPECT_LT((end.position - settled.position).norm(), 1e-6) << name;
    EXPECT_LT(end.orientation.angularDistance(settled.orientation), 1e-5) << name;
    EXPECT_LT((end.position.head<2>() - Eigen::Vector2d(0.3, -0.2)).norm(), 1e-3) << name;
  }
}

INSTANTIATE_TEST_SUITE_P(Conformance, EveryCollisionOfATeam, ::testing::ValuesIn(test::algorithms_of("collision")),
                         test::name_of);
INSTANTIATE_TEST_SUITE_P(Conformance, EveryAllocationFreeCollision,
                         ::testing::ValuesIn(test::collisions_that_promise(allocation_free)), test::name_of);

}  // namespace
}  // namespace muro
