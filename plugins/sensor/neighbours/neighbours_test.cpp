// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "muro/toolkit/rotations.hpp"
#include "plugins/sensor/common/neighbours/neighbour.hpp"
#include "tests/support/allocation_counter.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/complaint.hpp"

namespace muro::neighbours {
namespace {

using std::numbers::pi;
using Settings = std::map<std::string, ParameterInput>;
using Names = std::vector<std::string>;

/// Robots that are balls of 0.1 m, each with a device.
struct Swarm : test::Scene {
  explicit Swarm(std::uint64_t seed = 1) : Scene(seed) {}

  const RobotView& place(const std::string& name, const Vec3& at, double yaw = 0) {
    const RobotView& robot = add(name, test::ball(1, 0.1, 0.5), {at, from_rpy(0, 0, yaw)});
    devices.push_back({&robot, add_sensor_object(robot, "eyes", robot.base())});
    return robot;
  }
  void wall(const std::string& name, const Shape& shape, const Vec3& at) {
    world().add_scenery(name, {at, Quat::Identity()}, std::span<const Shape>(&shape, 1));
  }
  void start(Settings settings = {}, double rate = 10) {
    use("motion.point", 100, all_robots());
    use_kinematics();
    use("scene.bvh", 0);
    use("sensor.neighbours", rate, devices, std::move(settings));
    if (!errors.empty()) use("sensor.error", rate, devices, errors);
    build();
  }
  std::span<const Neighbour> seen(std::size_t device) { return world().values(devices[device].object, key_neighbours); }
  std::vector<double> ids(std::size_t device) {
    std::vector<double> all;
    for (const Neighbour& n : seen(device)) all.push_back(n.id);
    return all;
  }
  std::span<const Neighbour> measured(std::size_t device) {
    static const Key<Neighbour> key{"neighbours.measured", neighbours_unit, ""};
    return world().values(devices[device].object, key);
  }
  std::vector<Item> devices;
  Settings errors;  ///< settings of sensor.error; empty: there is no sensor.error
};

using Ids = std::vector<double>;

TEST(Neighbours, ReadDistanceBearingElevationAndHeading) {
  Swarm s;
  s.place("a", {1, 2, 0.5}, 0.5);
  s.place("b", {1 + 2 * std::cos(1.3), 2 + 2 * std::sin(1.3), 2.5}, -2.9);
  s.start({{"range", 5.0},
           {"offset", std::vector<double>{0, 0, 0.5}},
           {"target", std::vector<double>{0, 0, 0.25}},
           {"rpy", std::vector<double>{0, 0, 0.1}}});
  s.run_for(0.05);
  ASSERT_EQ(s.seen(0).size(), 1u);
  const Neighbour n = s.seen(0)[0];
  EXPECT_EQ(n.id, 1);
  EXPECT_NEAR(n.distance, std::hypot(2, 1.75), 1e-12);
  EXPECT_NEAR(n.bearing, 1.3 - 0.6, 1e-12);
  EXPECT_NEAR(n.elevation, std::atan2(1.75, 2), 1e-12);
  EXPECT_NEAR(n.heading, -2.9 - 0.6 + 2 * pi, 1e-12);
  EXPECT_NEAR(s.seen(1)[0].bearing, 1.3 - pi + 2.9 - 0.1, 1e-12) << "the other way round";
}

TEST(Neighbours, AreListedFromTheNearestOnAtMostSoMany) {
  Swarm s;
  s.place("a", {0, 0, 0});
  s.place("far", {3.001, 0, 0});
  s.place("third", {0, 2, 0});
  s.place("second", {0, -1, 0});
  s.place("as_second", {-1, 0, 0});
  s.place("first", {0.5, 0.1, 0});
  s.start({{"max_neighbours", std::int64_t(3)}});
  s.run_for(0.05);
  EXPECT_EQ(s.ids(0), (Ids{5, 3, 4})) << "of two at one distance that of the lower number comes first";
  Swarm t;
  for (const auto& [name, at] : {std::pair{"a", Vec3(0, 0, 0)}, {"far", Vec3(3.001, 0, 0)}, {"near", Vec3(3, 0, 0)}})
    t.place(name, at);
  t.start({{"line_of_sight", false}});
  t.run_for(0.05);
  EXPECT_EQ(t.ids(0), (Ids{2}));
}

TEST(Neighbours, AreHiddenBehindWallsAndOtherRobotsOnly) {
  for (const bool line_of_sight : {true, false}) {
    Swarm s;
    s.add_ground();
    s.place("a", {0, 0, 0});
    s.place("behind_a_wall", {2, 0, 0});
    s.place("between", {0, 1, 0});
    s.place("behind_a_robot", {0, 2, 0});
    s.place("beside_the_wall", {2, 1.2, 0});
    s.wall("wall", Shape::box({0.1, 1, 1}), {1, 0, 0.5});
    s.start({{"line_of_sight", line_of_sight}});
    s.run_for(0.05);
    EXPECT_EQ(s.ids(0), line_of_sight ? (Ids{2, 4}) : (Ids{2, 1, 3, 4}));
    EXPECT_EQ(s.ids(3), line_of_sight ? (Ids{2, 4, 1}) : (Ids{2, 0, 4, 1}));
  }
}

TEST(Neighbours, DependOnTheLineAtTheHeightOfAFloorToo) {
  Swarm s;
  s.wall("floor", Shape::box({20, 20, 1}), {0, 0, -0.5});
  s.wall("wall", Shape::box({0.1, 1, 1}), {1, 0, 0.5});
  s.place("a", {0, 0, 0});
  s.place("behind_the_wall", {2, 0, 0});
  s.place("on_the_floor", {0, 2, 0});
  s.start();
  s.run_for(0.05);
  EXPECT_EQ(s.ids(0), (Ids{2}));
}

TEST(Neighbours, HaveErrorsOfTheirOwnByTheChain) {
  Swarm s;
  s.place("a", {0, 0, 0});
  s.place("b", {2, 0, 0}, 1);
  s.place("c", {0, 2, 0}, pi);
  s.errors = {{"of", "neighbours"},
              {"sigma", std::vector<double>{0.03, 0.1, 0.05, 0.2}},
              {"sigma_relative", std::vector<double>{0.02, 0, 0, 0}},
              {"dropout", 0.25}};
  s.start({}, 100);
  const int steps = 8000;
  int count = 0;
  double sum[4] = {}, squares[4] = {}, together = 0;
  for (int k = 0; k < steps; ++k) {
    s.run_for(0.01);
    double distances[3] = {};
    ASSERT_EQ(s.seen(0).size(), 2u);
    for (const Neighbour& n : s.measured(0)) {
      distances[int(n.id)] = n.distance - 2;
      if (n.id != 1) continue;
      ++count;
      const double off[4] = {n.distance - 2, n.bearing, n.elevation, n.heading - 1};
      for (int i = 0; i < 4; ++i) sum[i] += off[i], squares[i] += off[i] * off[i];
    }
    together += distances[1] * distances[2];
  }
  EXPECT_NEAR(count, 0.75 * steps, 3 * std::sqrt(0.75 * 0.25 * steps));
  const double sigma[4] = {0.05, 0.1, 0.05, 0.2};  // sqrt(0.03^2 + 0.04^2)
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR(sum[i] / count, 0, 3 * sigma[i] / std::sqrt(count)) << i;
    EXPECT_NEAR(std::sqrt(squares[i] / count), sigma[i], 3 * sigma[i] / std::sqrt(2.0 * count)) << i;
  }
  EXPECT_NEAR(together / steps, 0, 3 * 0.05 * 0.05 / std::sqrt(steps)) << "of two neighbours are independent";
}

// a turn-on bias and a drift belong to the device: all its readings have the same error
TEST(Neighbours, ShareBiasAndDriftOfTheDeviceThatSeesThem) {
  Swarm s;
  s.place("a", {0, 0, 0});
  s.place("b", {2, 0, 0});
  s.place("c", {0, 1, 0});
  s.errors = {{"of", "neighbours"},
              {"turn_on_bias_tolerance", std::vector<double>{0, 0.3, 0, 0}},
              {"gauss_markov_sigma", std::vector<double>{0, 0.05, 0, 0}},
              {"gauss_markov_time", 2.0}};
  s.start({}, 100);
  double before = 0;
  for (int k = 0; k < 100; ++k) {
    s.run_for(0.01);
    const double off = s.measured(0)[0].bearing - pi / 2;
    EXPECT_NEAR(s.measured(0)[1].bearing, off, 1e-12);
    EXPECT_NE(off, before);
    EXPECT_EQ(s.measured(0)[0].distance, s.seen(0)[0].distance);
    before = off;
  }
  EXPECT_NE(s.measured(1)[0].bearing - s.seen(1)[0].bearing, before) << "another device";
}

TEST(Neighbours, HaveErrorsWhoeverElseIsThere) {
  const auto distance_of_b = [](bool alone) {
    Swarm s;
    if (!alone) s.place("another", {0.5, 0.5, 0});
    s.place("a", {0, 0, 0});
    s.place("b", {2, 0, 0});
    s.errors = {{"of", "neighbours"}, {"sigma", 0.1}, {"dropout", 0.1}};
    s.start();
    s.run_for(0.35);
    std::vector<double> distances;
    for (const Neighbour& n : s.measured(alone ? 0 : 1))
      if (n.id == (alone ? 1 : 2)) distances.push_back(n.distance);
    return distances;
  };
  EXPECT_EQ(distance_of_b(true), distance_of_b(false));
  EXPECT_EQ(distance_of_b(true).size(), 1u);
}

TEST(Neighbours, StayDistancesAndAnglesWithLargeErrors) {
  Swarm s;
  s.place("a", {0, 0, 0});
  for (int i = 1; i < 40; ++i) s.place("r" + std::to_string(i), {-0.05 * i, 0.01, 0}, 3);
  s.errors = {{"of", "neighbours"}, {"sigma", 2.0}};
  s.start({{"line_of_sight", false}});
  s.run_for(0.05);
  ASSERT_EQ(s.measured(0).size(), 32u);
  double distance = 0;
  for (const Neighbour& n : s.measured(0)) {
    EXPECT_GE(n.distance, distance) << "the nearest first, by what is read";
    EXPECT_LE(std::abs(n.bearing), pi);
    EXPECT_LE(std::abs(n.elevation), pi / 2);
    EXPECT_LE(std::abs(n.heading), pi);
    distance = n.distance;
  }
}

TEST(Neighbours, HaveNoErrorsThatNeedAReadingBefore) {
  Swarm s;
  s.place("a", {0, 0, 0});
  s.errors = {{"of", "neighbours"}, {"delay", 0.1}};
  EXPECT_SAYS(test::complaint_of([&] { s.start(); }),
              "delay is of a reading that is there at every instant, but `neighbours` is a list");
}

TEST(Neighbours, AreSeenByNameWhereThereAreNames) {
  const auto swarm = [](Names names) {
    auto s = std::make_unique<Swarm>();
    s->place("dog", {0, 0, 0});
    s->place("sheep_0", {1, 0, 0});
    s->place("sheep_1", {0, 2, 0});
    s->place("wolf", {0, 1.5, 0});
    s->world().set(s->devices[1].robot->base(), keys::shadow_of, s->devices[3].robot->base());
    s->start({{"robots", std::move(names)}, {"line_of_sight", false}});
    return s;
  };
  const auto sheep = swarm({"sheep_*"});
  sheep->run_for(0.05);
  EXPECT_EQ(sheep->ids(0), (Ids{2})) << "sheep_0 is a shadow";
  EXPECT_SAYS(test::complaint_of([&] { swarm({"wolf", "goat_*"}); }), "robots: no robot is called `goat_*`");
}

/// A crowd that moves on a disc with walls.
struct Crowd : Swarm {
  explicit Crowd(unsigned threads) : Swarm(7) {
    for (int i = 0; i < 120; ++i) {
      const double angle = 2.399963 * i, radius = 0.3 * std::sqrt(i);  // like the seeds of a sunflower
      place("r" + std::to_string(i), {radius * std::cos(angle), radius * std::sin(angle), 0}, angle);
    }
    for (int i = 0; i < 6; ++i) wall("wall" + std::to_string(i), Shape::box({0.5, 0.1, 1}), {0.4 * i - 1, 0.5, 0.2});
    set_threads(threads);
    errors = {{"of", "neighbours"},
              {"sigma", std::vector<double>{0.02, 0.1, 0, 0}},
              {"bias_instability", 0.01},
              {"dropout", 0.1}};
    start({{"range", 1.0}, {"max_neighbours", std::int64_t(6)}}, 50);
    command();
  }
  void command() {
    for (const Item& d : devices) world().value(d.robot->base(), keys::command_twist) = {{0.5, 0, 0}, {0, 0, 0.3}};
  }
};

TEST(Neighbours, AreTheSameToTheBitOnAnyNumberOfThreads) {
  const auto hash = [](unsigned threads) {
    Crowd s(threads);
    s.run_for(0.7);
    return s.state_hash();
  };
  const std::uint64_t one = hash(1);
  EXPECT_EQ(hash(2), one);
  EXPECT_EQ(hash(4), one);
}

TEST(Neighbours, GoOnFromASnapshotAndBeginAnewAfterAReset) {
  Crowd s(1);
  s.run_for(0.31);
  const Snapshot middle = s.snapshot();
  s.run_for(0.4);
  const std::uint64_t end = s.state_hash();
  s.restore(middle);
  s.run_for(0.4);
  EXPECT_EQ(s.state_hash(), end);
  s.reset();
  s.command();
  s.run_for(0.71);
  EXPECT_EQ(s.state_hash(), end);
}

TEST(Neighbours, AllocateNothingOnceWarm) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  Crowd s(1);
  s.run_for(0.5);
  const std::uint64_t before = test::allocations();
  ASSERT_GT(before, 0u);
  s.run_for(0.3);
  EXPECT_EQ(test::allocations() - before, 0u);
#endif
}

}  // namespace
}  // namespace muro::neighbours
