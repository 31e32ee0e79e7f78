// SPDX-License-Identifier: MIT
// The plugin in the complete simulator: index, poses of links, rates.
#include <gtest/gtest.h>

#include <cstdlib>
#include <numbers>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/scene.hpp"

namespace muro {
namespace {

using std::numbers::pi;
using test::Scene;

const Inertia unit_inertia{.mass = 1, .ixx = 1, .iyy = 1, .izz = 1};

/// Returns a rover: a base of 0.4 m with a mast that carries the scanner 0.3 m above its centre.
RobotTree rover() {
  return test::tree_of([](RobotBuilder& b) {
    b.base("base");
    b.set(keys::inertial, unit_inertia);
    const Shape box = Shape::box({0.4, 0.4, 0.2});
    b.set_array(keys::collision_shapes, std::span<const Shape>(&box, 1));
    b.translation({0, 0, 0.3});
    b.body("mast");
    b.set(keys::inertial, unit_inertia);
    const Shape disc = Shape::cylinder(0.1, 0.05);
    b.set_array(keys::collision_shapes, std::span<const Shape>(&disc, 1));
  });
}

struct Yard : Scene {
  /// Walls with their inner faces at x = +-5 and y = +-4, a pillar of radius 0.5 at (2, 2), flat ground at z = 0.
  Yard() {
    add_ground();
    wall("east", Shape::box({0.2, 8.4, 3}), {5.1, 0, 1.5});
    wall("west", Shape::box({0.2, 8.4, 3}), {-5.1, 0, 1.5});
    wall("north", Shape::box({10.4, 0.2, 3}), {0, 4.1, 1.5});
    wall("south", Shape::box({10.4, 0.2, 3}), {0, -4.1, 1.5});
    pillar = wall("pillar", Shape::cylinder(0.5, 3), {2, 2, 1.5});
  }
  ObjectId wall(const std::string& name, const Shape& shape, const Vec3& at) {
    return world().add_scenery(name, {at, Quat::Identity()}, std::span<const Shape>(&shape, 1));
  }
  /// Adds a robot with a scanner on its mast.
  ObjectId add_rover(const std::string& name, const Pose& start) {
    const RobotView& robot = add(name, rover(), start);
    const ObjectId scanner = add_sensor_object(robot, "scanner", world().object(name + "/mast"));
    scanners.push_back({&robot, scanner});
    return scanner;
  }
  void use_laser(std::map<std::string, ParameterInput> parameters) {
    use("motion.point", 100, all_robots());
    use_kinematics();
    use("scene.bvh", 0);
    use("laser.raycast", 10, scanners, std::move(parameters));
  }
  std::span<double> ranges(ObjectId scanner) { return world().values(scanner, keys::ranges); }
  std::vector<Item> scanners;
  ObjectId pillar = no_object;
};

/// Returns the distance to the inner faces of the yard.
double to_walls(const Vec3& from, double heading) {
  const double c = std::cos(heading), s = std::sin(heading);
  const double x = c > 0 ? (5 - from.x()) / c : (-5 - from.x()) / c;
  const double y = s > 0 ? (4 - from.y()) / s : (-4 - from.y()) / s;
  return std::min(x, y);
}

/// Returns the distance to the pillar, or a very large number.
double to_pillar(const Vec3& from, double heading) {
  const Eigen::Vector2d to(2 - from.x(), 2 - from.y()), d(std::cos(heading), std::sin(heading));
  const double along = to.dot(d), beside2 = to.squaredNorm() - along * along;
  return along > 0 && beside2 <= 0.25 ? along - std::sqrt(0.25 - beside2) : 1e9;
}

std::string message_of(Simulation& simulation) {
  return test::complaint_of([&] { simulation.build(); });
}

TEST(LaserRaycast, ReadsTheDistancesOfAYardFromARobotThatDrives) {
  Yard s;
  const ObjectId scanner = s.add_rover("rover", {{-2, -1, 0.1}, from_rpy(0, 0, 0.5)});
  s.use_laser({{"min_angle", -2.0862},
               {"max_angle", 2.0924},
               {"rays", std::int64_t(682)},
               {"max_range", 20.0},
               {"hits", true}});
  s.build();
  const RobotView& robot = *s.world().find_robot("rover");
  s.world().value(robot.base(), keys::command_twist) = {{0.7, 0, 0}, {0, 0, 0.4}};
  for (int scan = 0; scan < 15; ++scan) {
    s.run_for(scan == 0 ? 0.005 : 0.1);
    // the latest scan was taken 5 ms ago, before the motion of these 5 ms
    ASSERT_EQ(s.ranges(scanner).size(), 682u);
    const double t = 0.1 * scan, yaw = 0.5 + 0.4 * t, radius = 0.7 / 0.4;  // an exact arc
    const Vec3 at(-2 + radius * (std::sin(yaw) - std::sin(0.5)), -1 - radius * (std::cos(yaw) - std::cos(0.5)), 0.4);
    for (int i = 0; i < 682; ++i) {
      const double heading = yaw - 2.0862 + i * 4.1786 / 681;
      const double pillar = to_pillar(at, heading), walls = to_walls(at, heading);
      EXPECT_NEAR(s.ranges(scanner)[i], std::min(pillar, walls), 1e-9) << "scan " << scan << " ray " << i;
      EXPECT_EQ(s.world().values(scanner, keys::laser_hits)[i] == s.pillar, pillar < walls);
    }
  }
}

TEST(LaserRaycast, HoldsItsReadingBetweenScans) {
  Yard s;
  const ObjectId scanner = s.add_rover("rover", {{0, 0, 0.1}, Quat::Identity()});
  s.use_laser({{"rays", std::int64_t(1)}, {"max_range", 20.0}});
  s.build();
  s.world().value(s.world().find_robot("rover")->base(), keys::command_twist) = {{1, 0, 0}, {0, 0, 0}};
  std::vector<double> read;
  for (int ms = 0; ms < 300; ms += 10) {
    s.run_for(0.01);
    read.push_back(s.ranges(scanner)[0]);
  }
  for (int i = 0; i < 30; ++i) EXPECT_NEAR(read[i], 5 - 0.1 * std::floor(0.1 * i), 1e-12) << "10 scans a second";
}

TEST(LaserRaycast, SeesOtherRobotsWhereTheyAreAndItselfOnlyWhenTold) {
  for (const bool see_self : {false, true}) {
    Yard s;
    const ObjectId a = s.add_rover("a", {{-3, 0, 0.1}, Quat::Identity()});
    const ObjectId b = s.add_rover("b", {{1, 0, 0.1}, from_rpy(0, 0, pi)});
    s.use_laser({{"rays", std::int64_t(1)}, {"max_range", 20.0}, {"see_self", see_self}, {"hits", true}});
    s.build();
    s.world().value(s.world().find_robot("b")->base(), keys::command_twist) = {{1, 0, 0}, {0, 0, 0}};
    s.run_for(0.55);
    // masts face each other, 4 m minus 0.5 m apart at the last scan; a scanner inside its own mast reads 0
    EXPECT_NEAR(s.ranges(a)[0], see_self ? 0 : 3.4, 1e-9);
    EXPECT_NEAR(s.ranges(b)[0], see_self ? 0 : 3.4, 1e-9);
    EXPECT_EQ(s.world().values(a, keys::laser_hits)[0], s.world().object(see_self ? "a/mast" : "b/mast"));
  }
}

TEST(LaserRaycast, StandsWhereItIsMounted) {
  Yard s;
  const ObjectId scanner = s.add_rover("rover", {{0, 0, 0.1}, from_rpy(0, 0, pi / 2)});
  s.use_laser({{"rays", std::int64_t(1)},
               {"max_range", 20.0},
               {"offset", std::vector<double>{0.5, 0, 0.2}},
               {"rpy", std::vector<double>{0, pi / 2, 0}}});
  s.build();
  s.run_for(0.05);
  EXPECT_NEAR(s.ranges(scanner)[0], 0.6, 1e-12) << "looks down from 0.1 + 0.3 + 0.2 m";
  const Pose origin = s.world().value(scanner, keys::sensor_origin);
  EXPECT_EQ(origin.position, Vec3(0.5, 0, 0.2));
}

TEST(LaserRaycast, TellsItsPattern) {
  Yard s;
  const ObjectId scanner = s.add_rover("rover", {});
  s.use_laser({{"min_angle", -pi},
               {"max_angle", pi},
               {"rays", std::int64_t(8)},
               {"rows", std::int64_t(3)},
               {"min_elevation", -0.1},
               {"max_elevation", 0.1},
               {"min_range", 0.02},
               {"max_range", 5.6}});
  s.build();
  const World& w = s.world();
  EXPECT_EQ(w.value(scanner, keys::laser_min_angle), -pi);
  EXPECT_NEAR(w.value(scanner, keys::laser_angle_increment), pi / 4, 1e-15);
  EXPECT_EQ(w.value(scanner, keys::laser_columns), 8u);
  EXPECT_EQ(w.value(scanner, keys::laser_rows), 3u);
  EXPECT_EQ(w.value(scanner, keys::laser_min_range), 0.02);
  EXPECT_EQ(w.value(scanner, keys::laser_max_range), 5.6);
  EXPECT_EQ(s.ranges(scanner).size(), 24u);
}

TEST(LaserRaycast, TakesAListOfDirections) {
  Yard s;
  const ObjectId scanner = s.add_rover("rover", {{0, 0, 0.1}, Quat::Identity()});
  s.use_laser({{"directions", std::vector<double>{0, 0, pi / 2, 0, pi, 0, 0, -pi / 6}}, {"max_range", 20.0}});
  s.build();
  s.run_for(0.05);
  const double expected[] = {5, 4, 5, 0.8};  // 0.4 m above the ground, 30 degrees down
  for (int i = 0; i < 4; ++i) EXPECT_NEAR(s.ranges(scanner)[i], expected[i], 1e-12);
}

TEST(LaserRaycast, FeedsAnErrorModel) {
  Yard s;
  const ObjectId scanner = s.add_rover("rover", {{0, 0, 0.1}, Quat::Identity()});
  s.use_laser({{"min_angle", -0.5}, {"max_angle", 0.2}, {"rays", std::int64_t(200)}, {"max_range", 20.0}});
  s.use("sensor.error", 10, s.scanners, {{"sigma", 0.01}, {"correlation", 0.5}, {"resolution", 0.001}});
  s.build();
  double sum = 0;
  for (int scan = 0; scan < 50; ++scan) {
    s.run_for(0.1);
    for (int i = 0; i < 200; ++i) {
      const double error = s.world().values(scanner, keys::measured_ranges)[i] - s.ranges(scanner)[i];
      sum += error * error;
    }
  }
  const double n = 50 * 200, worth = n * (1 - 0.25) / (1 + 0.25);  // number of independent numbers
  EXPECT_NEAR(sum / n, 1e-4 + 1e-6 / 12, 5e-4 * std::sqrt(2 / worth));
}

TEST(LaserRaycast, GivesTheSameReadingsToRobotsInOneInstanceAndAlone) {
  Yard together, alone;
  const Pose start{{-2, -1, 0.1}, from_rpy(0.1, 0.05, 1)};
  together.add_rover("x", {{4, 3, 0.1}, Quat::Identity()});
  const ObjectId first = together.add_rover("rover", start), second = alone.add_rover("rover", start);
  for (Yard* s : {&together, &alone}) {
    s->use_laser({{"rays", std::int64_t(100)}, {"rows", std::int64_t(4)}, {"max_elevation", 0.3}, {"max_range", 4.0}});
    s->build();
    s->run_for(0.05);
  }
  const auto a = together.ranges(first), b = alone.ranges(second);
  EXPECT_TRUE(std::equal(a.begin(), a.end(), b.begin(), b.end())) << "x is out of reach";
}

/// Many rovers that drive between each other.
struct Crowd : Yard {
  explicit Crowd(std::map<std::string, ParameterInput> parameters) {
    for (int i = 0; i < 40; ++i) {
      const int row = i / 10, column = i % 10;
      add_rover("rover" + std::to_string(i), {{-4.5 + column, -3 + 1.5 * row, 0.1}, from_rpy(0, 0, 0.7 * i)});
    }
    parameters["max_range"] = 12.0;
    use_laser(std::move(parameters));
    build();
    for (const RobotView* r : world().robots())
      world().value(r->base(), keys::command_twist) = {{0.3 + 0.01 * index_of(r->id), 0, 0}, {0, 0, 0.5}};
  }
};

const std::vector<std::map<std::string, ParameterInput>> crowd_patterns = {
    {{"rays", std::int64_t(60)}, {"hits", true}},
    {{"rays", std::int64_t(90)}, {"rows", std::int64_t(7)}, {"max_elevation", 0.3}}};

TEST(LaserRaycast, ReadsTheSameOnAnyNumberOfThreads) {
  for (const auto& parameters : crowd_patterns) {
    Crowd one(parameters);
    one.run_for(0.55);
    for (const unsigned threads : {2u, 3u, 5u}) {
      Crowd several(parameters);
      several.set_threads(threads);
      several.run_for(0.55);
      EXPECT_EQ(one.state_hash(), several.state_hash()) << threads << " threads";
    }
  }
}

TEST(LaserRaycast, ReadsTheSameWithEveryInstructionSet) {
  for (const auto& parameters : crowd_patterns) {
    std::vector<std::uint64_t> hashes;
    for (const char* isa : {"base", "avx2", ""}) {
      ::setenv("MURO_ISA", isa, 1);
      Crowd crowd(parameters);
      crowd.run_for(0.25);
      hashes.push_back(crowd.state_hash());
    }
    ::unsetenv("MURO_ISA");
    EXPECT_EQ(hashes[0], hashes[1]);
    EXPECT_EQ(hashes[0], hashes[2]);
  }
}

TEST(LaserRaycast, GoesOnFromASnapshotAsItWouldHaveGoneOn) {
  Crowd crowd(crowd_patterns[0]);
  crowd.run_for(0.25);
  const Snapshot snapshot = crowd.snapshot();
  crowd.run_for(0.3);
  const std::uint64_t hash = crowd.state_hash();
  crowd.restore(snapshot);
  crowd.run_for(0.3);
  EXPECT_EQ(crowd.state_hash(), hash);
}

TEST(LaserRaycast, TouchesOnlyWhatItHasDeclared) {
  Crowd crowd(crowd_patterns[0]);
  crowd.verify_access();
  EXPECT_NO_THROW(crowd.run_for(0.15));
}

TEST(LaserRaycast, ExplainsWhatIsWrongWithItsParameters) {
  const auto message = [](std::map<std::string, ParameterInput> parameters) {
    Yard s;
    s.add_rover("rover", {});
    s.use_laser(std::move(parameters));
    return message_of(s);
  };
  using Strings = std::vector<std::pair<std::string, std::map<std::string, ParameterInput>>>;
  for (const auto& [expected, parameters] :
       Strings{{"min_angle (1) is greater than max_angle (0)", {{"min_angle", 1.0}, {"max_angle", 0.0}}},
               {"goes round once at most", {{"min_angle", -4.0}, {"max_angle", 4.0}}},
               {"min_range (5 m) must be less than max_range", {{"min_range", 5.0}, {"max_range", 4.0}}},
               {"directions and rays are both given",
                {{"directions", std::vector<double>{0, 0}}, {"rays", std::int64_t(3)}}},
               {"directions has 3 numbers", {{"directions", std::vector<double>{0, 0, 1}}}},
               {"directions has 1 number; ", {{"directions", std::vector<double>{0}}}}})
    EXPECT_NE(message(parameters).find(expected), std::string::npos) << message(parameters);
}

TEST(LaserRaycast, WarnsThatItDoesNotSeeMeshes) {
  Yard s;
  s.add_rover("rover", {});
  Shape mesh;
  mesh.kind = ShapeKind::mesh;
  mesh.size = Vec3::Ones();
  s.wall("statue", mesh, {1, 0, 0});
  std::string log;
  s.set_log([&](LogLevel level, std::string_view text) {
    if (level == LogLevel::warning) log += text;
  });
  s.use("motion.point", 100, s.all_robots());
  s.use("laser.raycast", 10, s.scanners);
  message_of(s);
  EXPECT_NE(log.find("does not see meshes: 1 collision shapes are left out, the first on statue"), std::string::npos)
      << log;
}

}  // namespace
}  // namespace muro
