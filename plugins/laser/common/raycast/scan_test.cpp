// SPDX-License-Identifier: MIT
// Scans of whole scenes, compared with a reference that tests every ray with every shape.
#include <gtest/gtest.h>

#include <atomic>
#include <cstdlib>
#include <new>
#include <numbers>

#include "muro/toolkit/rotations.hpp"
#include "ray_caster.hpp"
#include "test_scene.hpp"

namespace {
std::atomic<long> allocations{0};
}

// Not inlined: gcc 12 reports an inlined pair as mismatched.
[[gnu::noinline]] void* operator new(std::size_t size) {
  ++allocations;
  if (void* p = std::malloc(size)) return p;
  throw std::bad_alloc();
}
[[gnu::noinline]] void operator delete(void* p) noexcept { std::free(p); }
[[gnu::noinline]] void operator delete(void* p, std::size_t) noexcept { std::free(p); }

namespace muro::raycast {
namespace {

using std::numbers::pi;
using test::Dice;
using test::Reference;
using test::TestScene;

struct Scan {
  std::vector<double> ranges;
  std::vector<ObjectId> hits;
};

Scan scan(RayCaster& caster, const SceneIndex& scene, Viewpoint from, double min_range, const RayPattern& pattern) {
  Scan s{std::vector<double>(pattern.size()), std::vector<ObjectId>(pattern.size())};
  SceneTable table;
  table.build(scene);
  from.min_range = min_range;
  caster.cast(scan_kernels_for(lane::best_isa()), table, from, pattern, s.ranges, s.hits);
  return s;
}

std::vector<Vec3> directions(const RayPattern& pattern) {
  std::vector<Vec3> rays(pattern.size());
  for (const RayPacket& b : pattern.packets())
    for (std::uint32_t i = 0; i < b.count; ++i) rays[b.ray[i]] = Vec3(b.x[i], b.y[i], b.z[i]);
  return rays;
}

/// Returns all patterns of the tests: planar, round, tall, coarse, straight up, single, listed.
std::vector<RayPattern> patterns(Dice& dice) {
  std::vector<RayPattern> all;
  all.emplace_back(Grid{.min_angle = -2.0862, .max_angle = 2.0924, .columns = 682});
  all.emplace_back(Grid{.min_angle = -pi, .max_angle = pi, .columns = 360});
  all.emplace_back(
      Grid{.min_angle = -2, .max_angle = 2, .columns = 100, .min_elevation = -0.26, .max_elevation = 0.26, .rows = 10});
  all.emplace_back(
      Grid{.min_angle = 0, .max_angle = 2 * pi, .columns = 90, .min_elevation = 0.2, .max_elevation = 0.7, .rows = 16});
  all.emplace_back(Grid{.min_angle = -2, .max_angle = 2, .columns = 10});
  all.emplace_back(Grid{
      .min_angle = -pi, .max_angle = pi, .columns = 24, .min_elevation = -pi / 2, .max_elevation = pi / 2, .rows = 13});
  all.emplace_back(Grid{});
  std::vector<double> list;
  for (int i = 0; i < 150; ++i) {
    list.push_back(dice.between(-pi, pi));
    list.push_back(dice.between(-pi / 2, pi / 2));
  }
  all.emplace_back(std::span<const double>(list));
  return all;
}

/// Scatters shapes, and robots of several shapes.
TestScene city(Dice& dice, int things, int robots, bool ground) {
  TestScene scene;
  if (ground) scene.add_scenery(Shape::plane(), {{0, 0, -1.5}, from_rpy(0.1, 0.05, 0)});
  for (int i = 0; i < things; ++i) {
    const bool long_wall = i % 10 == 0;
    const Shape shape = long_wall ? Shape::box({dice.between(10, 60), 0.2, dice.between(1, 5)}) : dice.shape(0.1, 1.5);
    scene.add_scenery(shape, dice.pose(12));
  }
  for (int r = 0; r < robots; ++r) scene.add_robot({});
  return scene;
}

/// Moves the robots to new places.
void move_robots(TestScene& scene, Dice& dice) {
  for (std::size_t r = 0; r < scene.robot_count(); ++r) {
    const Pose base = dice.pose(10);
    Dice body{std::uint32_t(r)};  // the same body in every place
    scene.robot(r).clear();
    for (int k = 0; k < 4; ++k) scene.robot(r).push_back({body.shape(0.1, 0.4), base * body.pose(0.5)});
  }
}

/// Returns the number of rays that hit something.
int expect_agreement(const SceneIndex& scene, const Viewpoint& from, double min_range, const RayPattern& pattern,
                     const Scan& found) {
  const std::vector<Vec3> rays = directions(pattern);
  int hits = 0;
  for (std::size_t i = 0; i < rays.size(); ++i) {
    const Reference::Hit expected =
        Reference::cast(scene, from.device, rays[i], min_range, from.max_range, from.ignored_robot);
    EXPECT_NEAR(found.ranges[i], double(expected.distance), 1e-9) << "ray " << i;
    EXPECT_EQ(found.hits[i], expected.body) << "ray " << i;
    hits += expected.body != no_object;
  }
  return hits;
}

TEST(LaserScan, AgreesWithBruteForceForAllPatternsAmongMovingRobots) {
  Dice dice(5);
  RayCaster caster;
  const std::vector<RayPattern> all = patterns(dice);
  int hits = 0, rays = 0;
  for (int round = 0; round < 6; ++round) {
    TestScene scene = city(dice, 20 * round, 8, round % 2 == 1);
    for (int time = 0; time < 3; ++time) {
      move_robots(scene, dice);
      const SceneIndex& index = scene.index();
      for (const RayPattern& pattern : all) {
        const Viewpoint from{dice.pose(8), dice.between(4, 40), time == 0 ? no_robot : RobotId(std::uint32_t(time))};
        const Scan found = scan(caster, index, from, 0.02, pattern);
        hits += expect_agreement(index, from, 0.02, pattern, found);
        rays += int(pattern.size());
      }
    }
  }
  EXPECT_GT(hits, rays / 10);
  EXPECT_LT(hits, rays * 9 / 10);
}

TEST(LaserScan, AgreesWithBruteForceForALevelScannerOnATurningRobot) {
  // The usual case: upright boxes, a level device, all faces parallel or perpendicular to the plane of the scan.
  Dice dice(6);
  RayCaster caster;
  const RayPattern pattern(Grid{.min_angle = -2.0862, .max_angle = 2.0924, .columns = 682});
  TestScene scene;
  scene.add_scenery(Shape::plane(), {});
  for (int x = -3; x <= 3; ++x)
    for (int y = -3; y <= 3; ++y)
      scene.add_scenery(Shape::box({1, 1, 2}), {{3.0 * x + 1.5, 3.0 * y + 1.5, 1}, Quat::Identity()});
  const SceneIndex& index = scene.index();
  for (int i = 0; i < 40; ++i) {
    const Viewpoint from{
        {{dice.between(-0.9, 0.9), dice.between(-0.9, 0.9), 0.15}, from_rpy(0, 0, i * pi / 20)}, 5.6, no_robot};
    EXPECT_GT(expect_agreement(index, from, 0.02, pattern, scan(caster, index, from, 0.02, pattern)), 100);
  }
}

TEST(LaserScan, SeparatesObjectsAMillimetreBehindEachOther) {
  // Slats of 2 cm, seen by three or four rays each, in an order that is not their order by distance. Then the same just
  // within the greatest range.
  RayCaster caster;
  const RayPattern pattern(Grid{.min_angle = -0.3, .max_angle = 0.3, .columns = 320});
  for (const double distance : {3.0, 5.58}) {
    TestScene scene;
    for (int i = -50; i <= 50; ++i) {
      const double behind = 0.001 * ((i + 50) * 7 % 16);
      scene.add_scenery(Shape::box({0.0005, 0.02, 1}), {{distance + behind, 0.02 * i, 0}, Quat::Identity()});
    }
    const SceneIndex& index = scene.index();
    const Viewpoint from{{}, 5.6, no_robot};
    EXPECT_GT(expect_agreement(index, from, 0, pattern, scan(caster, index, from, 0, pattern)), 20);
  }
}

TEST(LaserScan, GivesClosedFormDistancesAtAnyIncidenceInAnyFrame) {
  Dice dice(7);
  RayCaster caster;
  for (int round = 0; round < 20; ++round) {
    const Pose world = dice.pose(50);  // pose of the whole arrangement
    for (const double incidence : {0.0, pi / 4, 80 * pi / 180}) {
      const double aim[] = {incidence, 0};
      const RayPattern one{std::span<const double>(aim)};
      TestScene wall;
      wall.add_scenery(Shape::box({0.4, 100, 3}), world * Pose{{3.2, 0, 0}, Quat::Identity()});
      EXPECT_NEAR(scan(caster, wall.index(), {world, 30, no_robot}, 0, one).ranges[0], 3 / std::cos(incidence), 1e-9);

      // at 3 m from the surface, turned so that the ray passes the centre at r sin(incidence)
      const double radius = 0.5, centre = 3 + radius, passing = std::asin(radius * std::sin(incidence) / centre);
      const double turned[] = {passing, 0};
      const RayPattern past{std::span<const double>(turned)};
      const double expected = centre * std::cos(passing) - radius * std::cos(incidence);
      for (const Shape& shape : {Shape::sphere(radius), Shape::cylinder(radius, 2), Shape::capsule(radius, 2)}) {
        TestScene scene;
        scene.add_scenery(shape, world * Pose{{centre, 0, 0}, Quat::Identity()});
        EXPECT_NEAR(scan(caster, scene.index(), {world, 30, no_robot}, 0, past).ranges[0], expected, 1e-9);
      }
    }
  }
}

TEST(LaserScan, AgreesWithBruteForceInACrowd) {
  // More boxes than fit into sixteen blocks of sixteen, and more in range than a sector tests one by one.
  Dice dice(14);
  RayCaster caster;
  TestScene scene = city(dice, 700, 40, true);
  move_robots(scene, dice);
  const SceneIndex& index = scene.index();
  for (const RayPattern& pattern : patterns(dice)) {
    const Viewpoint from{{dice.in_box(2) + Vec3(14, 0, 0), dice.rotation()}, 40};
    EXPECT_GT(expect_agreement(index, from, 0, pattern, scan(caster, index, from, 0, pattern)), 0);
  }
}

TEST(LaserScan, AgreesWithBruteForceFarFromTheOriginWithAllSizes) {
  Dice dice(15);
  RayCaster caster;
  const Vec3 far(3e4, -2e4, 100);
  TestScene scene;
  scene.add_scenery(Shape::box({5e4, 5e4, 1}), {far - Vec3(0, 0, 3), Quat::Identity()});
  scene.add_scenery(Shape::sphere(1), {});
  for (int i = 0; i < 100; ++i) {
    const double size = std::pow(10, dice.between(-3, 0.5));
    scene.add_scenery(dice.shape(size, 2 * size), {far + dice.in_box(8), dice.rotation()});
  }
  const SceneIndex& index = scene.index();
  for (const double range : {10.0, 1e5})
    for (const RayPattern& pattern : patterns(dice)) {
      const Viewpoint from{{far + dice.in_box(2), dice.rotation()}, range};
      const Scan found = scan(caster, index, from, 0, pattern);
      const std::vector<Vec3> rays = directions(pattern);
      for (std::size_t i = 0; i < rays.size(); ++i) {
        const Reference::Hit expected = Reference::cast(index, from.device, rays[i], 0, range, no_robot);
        // coordinates are 2^-38 m apart there, and a grazing ray makes more of it
        EXPECT_NEAR(found.ranges[i], double(expected.distance), 1e-8 * std::max(1.0, double(expected.distance)));
        EXPECT_EQ(found.hits[i], expected.body);
      }
    }
}

TEST(LaserScan, SeesTheFirstOfTwoThingsAtTheSameDistance) {
  // Faces in one plane, in scenery and in a robot. The rays are parallel to no face.
  TestScene scene;
  const ObjectId first = scene.add_scenery(Shape::box({2, 2, 2}), {{5, 0, 0}, Quat::Identity()});
  scene.add_scenery(Shape::box({1, 4, 4}), {{4.5, 0, 0}, Quat::Identity()});
  scene.add_robot({{Shape::box({4, 1, 1}), {{6, 0, 0}, Quat::Identity()}}});
  RayCaster caster;
  const RayPattern pattern(Grid{.min_angle = -0.2, .max_angle = 0.2, .columns = 33});
  const Scan s = scan(caster, scene.index(), {{}, 10}, 0, pattern);
  for (const ObjectId hit : s.hits) EXPECT_EQ(hit, first);
}

TEST(LaserScan, SeesNothingFromAPlaceThatIsNotFinite) {
  Dice dice(16);
  TestScene scene = city(dice, 50, 8, true);
  move_robots(scene, dice);
  RayCaster caster;
  const RayPattern pattern(Grid{.min_angle = -1, .max_angle = 1, .columns = 20});
  const Vec3 nowhere(std::numeric_limits<double>::quiet_NaN(), 0, 0);
  const Scan s = scan(caster, scene.index(), {{nowhere, Quat::Identity()}, 5.6}, 0, pattern);
  for (const double r : s.ranges) EXPECT_EQ(r, 5.6);
  for (const ObjectId hit : s.hits) EXPECT_EQ(hit, no_object);
}

TEST(LaserScan, SeesItsOwnRobotOnlyWhenToldTo) {
  TestScene scene;
  const ObjectId other = scene.add_robot({{Shape::box({1, 1, 1}), {{4, 0, 0}, Quat::Identity()}}});
  const ObjectId self = scene.add_robot({{Shape::box({0.1, 1, 1}), {{1, 0, 0}, Quat::Identity()}}});
  RayCaster caster;
  const RayPattern ahead{Grid{}};
  const Scan without = scan(caster, scene.index(), {{}, 10, RobotId{1}}, 0, ahead);
  EXPECT_NEAR(without.ranges[0], 3.5, 1e-12);
  EXPECT_EQ(without.hits[0], other);
  const Scan with = scan(caster, scene.index(), {{}, 10, no_robot}, 0, ahead);
  EXPECT_NEAR(with.ranges[0], 0.95, 1e-12);
  EXPECT_EQ(with.hits[0], self);
}

TEST(LaserScan, ReadsMaxRangeForNothingAndMinRangeForWhatIsTooNear) {
  TestScene scene;
  const ObjectId near = scene.add_scenery(Shape::box({0.1, 1, 1}), {{0.1, 0, 0}, Quat::Identity()});
  scene.add_scenery(Shape::box({1, 1, 1}), {{-7, 0, 0}, Quat::Identity()});
  RayCaster caster;
  const Scan s = scan(caster, scene.index(), {{}, 5.6, no_robot}, 0.2,
                      RayPattern(Grid{.min_angle = 0, .max_angle = pi, .columns = 3}));
  EXPECT_EQ(s.ranges, (std::vector<double>{0.2, 5.6, 5.6}));
  EXPECT_EQ(s.hits, (std::vector<ObjectId>{near, no_object, no_object}));
}

TEST(LaserScan, ReadsTheLeastRangeFromInsideASolid) {
  TestScene scene;
  const ObjectId solid = scene.add_scenery(Shape::sphere(2), {});
  RayCaster caster;
  const RayPattern round(Grid{.min_angle = -pi, .max_angle = pi, .columns = 36});
  const Scan s = scan(caster, scene.index(), {{{0.5, 0, 0}, Quat::Identity()}, 5.6, no_robot}, 0.02, round);
  for (const double r : s.ranges) EXPECT_EQ(r, 0.02);
  for (const ObjectId hit : s.hits) EXPECT_EQ(hit, solid);
}

TEST(LaserScan, MeasuresTheHeightOverATiltedPlane) {
  TestScene scene;
  scene.add_scenery(Shape::plane(), {{0, 0, 0}, from_rpy(0.3, 0, 0)});
  RayCaster caster;
  const double down[] = {0, -pi / 2, 0, pi / 2};
  const Scan s = scan(caster, scene.index(), {{{5, 1, 2}, Quat::Identity()}, 50, no_robot}, 0,
                      RayPattern(std::span<const double>(down)));
  EXPECT_NEAR(s.ranges[0], 2 - std::tan(0.3), 1e-12);
  EXPECT_EQ(s.ranges[1], 50);
}

TEST(LaserScan, SeesAnEmptySceneAsEmpty) {
  RayCaster caster;
  const SceneIndex nothing;
  const Scan s =
      scan(caster, nothing, {{}, 5.6, no_robot}, 0, RayPattern(Grid{.min_angle = -1, .max_angle = 1, .columns = 20}));
  for (const double r : s.ranges) EXPECT_EQ(r, 5.6);
}

TEST(LaserScan, AllocatesNothingOnceItHasSeenTheScene) {
  Dice dice(8);
  TestScene scene = city(dice, 100, 8, true);
  move_robots(scene, dice);
  RayCaster caster;
  SceneTable table;
  table.build(scene.index());
  const RayPattern pattern(Grid{.min_angle = -2, .max_angle = 2, .columns = 200});
  caster.reserve(table, pattern);
  std::vector<double> ranges(pattern.size());
  std::vector<ObjectId> hits(pattern.size());
  for (int i = 0; i < 20; ++i) {
    move_robots(scene, dice);
    const SceneIndex& index = scene.index();
    const Viewpoint from{dice.pose(8), dice.between(4, 40)};
    const long before = allocations;
    table.update(index);
    caster.cast(scan_kernels_for(lane::best_isa()), table, from, pattern, ranges, hits);
    EXPECT_EQ(allocations, before);
  }
}

TEST(LaserScan, DoesNotDependOnWhatTheCasterDidBefore) {
  Dice dice(9);
  TestScene scene = city(dice, 60, 8, true);
  move_robots(scene, dice);
  const SceneIndex& index = scene.index();
  const RayPattern pattern(Grid{.min_angle = -pi, .max_angle = pi, .columns = 360});
  RayCaster used;
  for (int i = 0; i < 10; ++i) {
    const Viewpoint from{dice.pose(8), 20, no_robot};
    RayCaster fresh;
    const Scan a = scan(used, index, from, 0, pattern), b = scan(fresh, index, from, 0, pattern);
    EXPECT_EQ(a.ranges, b.ranges);
    EXPECT_EQ(a.hits, b.hits);
  }
}

}  // namespace
}  // namespace muro::raycast
