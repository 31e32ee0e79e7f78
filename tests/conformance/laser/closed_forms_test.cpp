// SPDX-License-Identifier: MIT
// Every laser method compared with distances that have a closed form.
#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/laser/room.hpp"
#include "tests/support/files.hpp"

namespace muro {
namespace {

using namespace test;

class EveryLaser : public testing::TestWithParam<std::string> {};
INSTANTIATE_TEST_SUITE_P(Conformance, EveryLaser, testing::ValuesIn(laser_methods()), method_name);

/// Returns the distance to the inner faces of the furnished room, level from `from` along `heading`.
double to_walls(const Vec3& from, double heading) {
  const double c = std::cos(heading), s = std::sin(heading);
  return std::min((std::copysign(5, c) - from.x()) / c, (std::copysign(4, s) - from.y()) / s);
}

/// Returns the distance to its pillar, or 1e9 if there is no hit.
double to_pillar(const Vec3& from, double heading) {
  const Eigen::Vector2d to(2 - from.x(), 2 - from.y()), d(std::cos(heading), std::sin(heading));
  const double along = to.dot(d), beside2 = to.squaredNorm() - along * along;
  return along > 0 && beside2 <= 0.25 ? along - std::sqrt(0.25 - beside2) : 1e9;
}

TEST_P(EveryLaser, ReadsTheWallsOfARoomAllTheWayRound) {
  for (const double degrees : {60, 240, 270, 360}) {
    const double wide = degrees * pi / 180, yaw = 0.4;
    const Vec3 at(-1, 0.5, 1);
    Room s({at, from_rpy(0, 0, yaw)});
    s.furnish();
    const int rays = 720;
    s.add_laser(GetParam(), {{"rays", std::int64_t(rays)}, {"min_angle", -0.5 * wide}, {"max_angle", 0.5 * wide}});
    s.build_and_run();
    const double step = degrees < 360 ? wide / (rays - 1) : wide / rays;
    const Bound bound = bound_of(GetParam(), step, 1);
    int edges = 0;
    for (int i = 0; i < rays; ++i) {
      const auto exact = [&](double aside) {
        const double heading = yaw - 0.5 * wide + i * step + aside;
        return std::min(to_walls(at, heading), to_pillar(at, heading));
      };
      const double bend = 1 / exact(bound.blur) - 2 / exact(0) + 1 / exact(-bound.blur);
      const bool edge = std::abs(bend) * exact(0) > 0.01;
      edges += edge;
      if (edge) continue;
      // between pixels a method reads the chord of a curve
      const double curved = 0.25 * std::abs(bend) * exact(0) * exact(0);
      EXPECT_NEAR(s.ranges(0)[i], exact(0), bound.absolute + bound.relative * exact(0) + curved)
          << i << " of " << degrees;
    }
    EXPECT_LT(edges, 25);
  }
}

TEST_P(EveryLaser, ReadsGroundAndCeilingWithSeveralRows) {
  const double low = -1.2, high = 1.3;
  const int rows = 126, columns = 30;
  Room s({{0.3, 0.2, 1}, from_rpy(0, 0, 0.3)});
  s.add_ground();
  s.put("ceiling", Shape::box({60, 60, 0.2}), {{0, 0, 2.6}, Quat::Identity()});
  s.add_laser(
      GetParam(),
      {{"rays", std::int64_t(columns)}, {"rows", std::int64_t(rows)}, {"min_elevation", low}, {"max_elevation", high}});
  s.build_and_run();
  const Bound bound = bound_of(GetParam(), 0.02, 1);
  for (int row = 0; row < rows; ++row) {
    const double e = low + row * (high - low) / (rows - 1);
    const double exact = std::min(20.0, e < 0 ? -1 / std::sin(e) : 1.5 / std::sin(e));
    if (exact > 19) continue;
    for (int column = 0; column < columns; ++column)
      EXPECT_NEAR(s.ranges(0)[row * columns + column], exact, bound.absolute + bound.relative * exact)
          << row << ", " << column;
  }
}

TEST_P(EveryLaser, ReadsEveryKindOfShapeAtItsDistance) {
  const std::pair<Shape, double> shapes[] = {{Shape::box({1, 1, 1}), 2.5},
                                             {Shape::sphere(0.5), 2.5},
                                             {Shape::cylinder(0.5, 1), 2.5},
                                             {Shape::capsule(0.5, 1), 2.5},
                                             {Shape::plane(), 3}};
  for (const auto& [shape, distance] : shapes) {
    Room s;
    const bool plane = shape.kind == ShapeKind::plane;
    const ObjectId thing = s.put("thing", shape, {{3, 0, 1}, plane ? from_rpy(0, -pi / 2, 0) : from_rpy(0, 0, pi)});
    s.add_laser(GetParam(), {{"rays", std::int64_t(21)}, {"min_angle", -0.1}, {"max_angle", 0.1}, {"hits", true}});
    s.build_and_run();
    EXPECT_NEAR(s.ranges(0)[10], distance, bound_of(GetParam(), 0.01, 1).absolute) << int(shape.kind);
    EXPECT_EQ(s.hits(0)[10], thing);
  }
}

TEST_P(EveryLaser, ReadsItsRangeWhereNothingIs) {
  Room s;
  s.put("far", Shape::box({1, 40, 40}), {{25, 0, 0}, Quat::Identity()});
  s.add_laser(GetParam(), {{"rays", std::int64_t(9)}, {"min_angle", -1.0}, {"max_angle", 1.0}, {"hits", true}});
  s.build_and_run();
  for (const double r : s.ranges(0)) EXPECT_EQ(r, 20);
  for (const ObjectId hit : s.hits(0)) EXPECT_EQ(hit, no_object);
}

TEST_P(EveryLaser, ReadsItsLeastRangeForWhatIsNearer) {
  Room s;
  const ObjectId near = s.put("near", Shape::box({0.1, 1, 1}), {{0.35, 0, 1}, Quat::Identity()});
  s.add_laser(GetParam(), {{"rays", std::int64_t(1)}, {"min_range", 0.5}, {"hits", true}});
  s.build_and_run();
  EXPECT_EQ(s.ranges(0)[0], 0.5);
  EXPECT_EQ(s.hits(0)[0], near);
}

TEST_P(EveryLaser, DoesNotLookThroughWhatIsVeryNear) {
  for (const double angle : {0.0, 0.6}) {
    Room s;
    s.put("plate", Shape::box({0.004, 1, 1}), {{0.02, 0, 1}, Quat::Identity()});
    s.put("wall", Shape::box({0.2, 9, 9}), {{4, 0, 1}, Quat::Identity()});
    s.add_laser(GetParam(), {{"directions", std::vector<double>{angle, 0}}, {"min_range", 0.2}});
    s.build_and_run();
    EXPECT_EQ(s.ranges(0)[0], 0.2) << angle;
  }
}

TEST_P(EveryLaser, IsBlindInASolid) {
  for (const Shape& shape :
       {Shape::box({1, 1, 1}), Shape::sphere(0.5), Shape::cylinder(0.5, 1), Shape::capsule(0.5, 1)}) {
    Room s;
    const ObjectId around = s.put("around", shape, {{0.1, 0, 1}, Quat::Identity()});
    s.add_laser(GetParam(), {{"rays", std::int64_t(5)}, {"min_range", 0.02}, {"hits", true}});
    s.build_and_run();
    for (const double r : s.ranges(0)) EXPECT_EQ(r, 0.02);
    for (const ObjectId hit : s.hits(0)) EXPECT_EQ(hit, around);
  }
}

TEST_P(EveryLaser, SeesWhatIsInFront) {
  Room s;
  s.put("far", Shape::box({0.2, 6, 6}), {{5.1, 0, 1}, Quat::Identity()});
  const ObjectId near = s.put("near", Shape::box({0.2, 1, 1}), {{2.1, 0.5, 1}, Quat::Identity()});
  s.add_laser(GetParam(), {{"rays", std::int64_t(3)}, {"min_angle", -0.2}, {"max_angle", 0.2}, {"hits", true}});
  s.build_and_run();
  EXPECT_NEAR(s.ranges(0)[0], 5 / std::cos(0.2), 1e-3);
  EXPECT_NEAR(s.ranges(0)[2], 2 / std::cos(0.2), 1e-3);
  EXPECT_EQ(s.hits(0)[2], near);
}

TEST_P(EveryLaser, ReadsTheSameAKilometreFromTheOrigin) {
  const Pose far{{1200, -800, 50}, from_rpy(0, 0, 0.5)};
  Room s(far);
  s.put("wall", Shape::box({0.2, 10, 10}), far * Pose{{3.1, 0, 0}, Quat::Identity()});
  s.add_laser(GetParam(), {{"rays", std::int64_t(101)}, {"min_angle", -0.5}, {"max_angle", 0.5}});
  s.build_and_run();
  for (int i = 0; i <= 100; ++i) EXPECT_NEAR(s.ranges(0)[i], 3 / std::cos(-0.5 + 0.01 * i), 2e-4);
}

TEST_P(EveryLaser, TakesAListOfDirections) {
  Room s({{0, 0, 1}, Quat::Identity()});
  s.furnish();
  s.add_laser(GetParam(), {{"directions", std::vector<double>{0, 0, pi / 2, 0, pi, 0, 0, -pi / 6, 1, -pi / 2}}});
  s.build_and_run();
  const double expected[] = {5, 4, 5, 2, 1};
  for (int i = 0; i < 5; ++i) EXPECT_NEAR(s.ranges(0)[i], expected[i], 2e-4) << i;
}

TEST_P(EveryLaser, SeesItsRobotOnlyWhenTold) {
  for (const bool see_self : {false, true}) {
    Room s;
    const RobotView& robot = s.add("robot", block(1, {0.4, 0.4, 0.2}, 0.5), {{0, 3, 0.1}, Quat::Identity()});
    const ObjectId sensor = s.add_sensor_object(robot, "down", robot.base());
    s.add_ground();
    s.use("motion.point", 100, s.all_robots());
    s.use_kinematics();
    s.use("scene.bvh", 0);
    s.use(GetParam(), 10, {{&robot, sensor}},
          {{"rays", std::int64_t(1)},
           {"max_range", 20.0},
           {"see_self", see_self},
           {"offset", std::vector<double>{0, 0, 0.4}},
           {"rpy", std::vector<double>{0, pi / 2, 0}}});
    s.build();
    s.run_for(0.005);
    EXPECT_NEAR(s.world().values(sensor, keys::ranges)[0], see_self ? 0.3 : 0.5, 2e-4);
  }
}

TEST_P(EveryLaser, SeesRobotsWhereTheyHaveGone) {
  Room s;
  const RobotView& other = s.add("other", ball(1, 0.5, 0.5), {{3, 0, 1}, Quat::Identity()});
  s.add_laser(GetParam(), {{"rays", std::int64_t(1)}});
  s.build_and_run();
  EXPECT_NEAR(s.ranges(0)[0], 2.5, 2e-4);
  s.world().value(other.base(), keys::command_twist) = {{1, 0, 0}, {0, 0, 0}};
  s.run_for(1);
  EXPECT_NEAR(s.ranges(0)[0], 3.49, 2e-4) << "the scan at 1 s; it has moved since 0.01 s";
}

TEST_P(EveryLaser, SeesMeshesOrSaysThatItDoesNot) {
  Room s;
  const ScratchFolder folder;
  Shape mesh;
  mesh.kind = ShapeKind::mesh;
  mesh.size = Vec3(1, 2, 3);
  mesh.mesh = s.world().intern(folder.file("cube.obj",
                                           "v -0.5 -0.5 -0.5\nv 0.5 -0.5 -0.5\nv -0.5 0.5 -0.5\nv 0.5 0.5 -0.5\n"
                                           "v -0.5 -0.5 0.5\nv 0.5 -0.5 0.5\nv -0.5 0.5 0.5\nv 0.5 0.5 0.5\n"
                                           "f 1 3 4 2\nf 5 6 8 7\nf 1 2 6 5\nf 3 7 8 4\nf 1 5 7 3\nf 2 4 8 6\n"));
  const ObjectId crate = s.put("crate", mesh, {{3, 0, 1}, Quat::Identity()});
  s.put("wall", Shape::box({0.2, 8, 8}), {{8.1, 0, 1}, Quat::Identity()});
  std::string log;
  s.set_log([&](LogLevel level, std::string_view text) {
    if (level == LogLevel::warning) log += text;
  });
  s.add_laser(GetParam(), {{"rays", std::int64_t(3)}, {"min_angle", -0.1}, {"max_angle", 0.1}, {"hits", true}});
  s.build_and_run();
  if (log.find("not see") != std::string::npos) {
    EXPECT_NEAR(s.ranges(0)[1], 8, 2e-4) << "looks through it";
    return;
  }
  EXPECT_EQ(log, "");
  EXPECT_NEAR(s.ranges(0)[1], 2.5, 2e-4);
  EXPECT_NEAR(s.ranges(0)[0], 2.5 / std::cos(0.1), 2e-4);
  EXPECT_EQ(s.hits(0)[1], crate);
}

}  // namespace
}  // namespace muro
