// SPDX-License-Identifier: MIT
// Tests of points that keep a height above heightmaps.
#include <gtest/gtest.h>

#include <random>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/bodies.hpp"
#include "tests/support/hills.hpp"

namespace muro {
namespace {

using Settings = std::map<std::string, ParameterInput>;

struct PointOnHills : test::Scene {
  const RobotView& robot;
  PointOnHills(const test::Hills& hills, const Settings& settings, const Pose& start, const Pose& hills_at = {})
      : robot(
            (hills.add_to(*this, hills_at), add("point", test::single_body(Shape::sphere(0.1), {.mass = 1}), start))) {
    use("motion.point", 100, all_robots(), settings);
    build();
  }
  Pose& at() { return pose(robot); }
  Twist& command() { return world().value(robot.base(), keys::command_twist); }
};

test::Hills slope() {
  return {32, 64, [](double x, double y) { return 0.25 * x - 0.125 * y; }};
}

TEST(PointMotionOnTerrain, KeepsItsHeightAboveAnInclinedPlane) {
  const test::Hills hills = slope();
  PointOnHills s(hills, {{"height_above_ground", 1.5}}, {{1, 2, -7}, from_rpy(0, 0, 0.6)});
  EXPECT_NEAR(s.at().position.z(), 1.5, 1e-12) << "from the start";
  s.command() = {{2, 0, -9}, {0, 0, 0}};
  s.run_for(3);
  const Vec3 expected = Vec3(1, 2, 0) + 6 * Vec3(std::cos(0.6), std::sin(0.6), 0);
  EXPECT_NEAR(s.at().position.x(), expected.x(), 1e-9) << "the horizontal velocity is the commanded one";
  EXPECT_NEAR(s.at().position.y(), expected.y(), 1e-9);
  EXPECT_NEAR(s.at().position.z(), 1.5 + 0.25 * expected.x() - 0.125 * expected.y(), 1e-9);
  EXPECT_NEAR(s.twist(s.robot).linear.z(), 2 * (0.25 * std::cos(0.6) - 0.125 * std::sin(0.6)), 1e-12);
  EXPECT_NEAR((s.at().orientation * Vec3::UnitZ()).z(), 1, 1e-12) << "it does not tilt";
}

TEST(PointMotionOnTerrain, IsWhereTheSurfaceOfAHeightmapIsDefinedToBe) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> any(-1, 1);
  const test::Hills hills(8, 7, [&](double, double) { return any(engine); });
  for (const Pose& at : {Pose{}, Pose{{3, -2, 5}, from_rpy(0, 0, 0.7)}, Pose{{3, -2, 5}, from_rpy(0.1, -0.2, 0.7)}}) {
    PointOnHills s(hills, {{"height_above_ground", 0.0}}, {}, at);
    for (int i = 0; i < 300; ++i) {
      const Vec3 over = at * Vec3(4.5 * any(engine), 4.5 * any(engine), 0);
      s.at().position = {over.x(), over.y(), 100};
      s.run_for(0.01);
      const Vec3 in_map = at.inverse() * s.at().position;
      const auto ground = hills.heightmap().ground_at(in_map.x(), in_map.y());
      if (ground) {
        EXPECT_NEAR(in_map.z(), ground->height, 1e-12) << in_map.transpose();
      } else {
        EXPECT_EQ(s.at().position.z(), 100);
      }
    }
  }
}

TEST(PointMotionOnTerrain, KeepsItsHeightOnTheWayToAPose) {
  const test::Hills hills = slope();
  PointOnHills s(hills, {{"height_above_ground", 0.0}, {"mode", std::string("pose")}, {"max_speed", 1.0}}, {});
  s.world().value(s.robot.base(), keys::command_pose) = {{4, 0, 100}, Quat::Identity()};
  s.run_for(3);
  EXPECT_NEAR(s.at().position.x(), 3, 1e-9);
  EXPECT_NEAR(s.at().position.z(), 0.75, 1e-9);
  s.run_for(2);
  EXPECT_NEAR(s.at().position.x(), 4, 1e-9);
  EXPECT_NEAR(s.at().position.z(), 1, 1e-9);
}

TEST(PointMotionOnTerrain, BeyondTheRimKeepsTheHeightOfTheRim) {
  const test::Hills hills = slope();
  PointOnHills s(hills, {{"height_above_ground", 1.0}}, {{15, 0, 0}, Quat::Identity()});
  s.command() = {{1, 0, 0}, {0, 0, 0}};
  s.run_for(3);
  EXPECT_NEAR(s.at().position.x(), 18, 1e-9);
  EXPECT_NEAR(s.at().position.z(), 1 + 0.25 * 16, 0.01 * 0.25 + 1e-9);
  EXPECT_EQ(s.twist(s.robot).linear.z(), 0);
}

TEST(PointMotionOnTerrain, WithoutAHeightTerrainIsNothingToIt) {
  const test::Hills hills = slope();
  PointOnHills s(hills, {}, {{1, 2, -7}, Quat::Identity()});
  s.command() = {{1, 0, 0.5}, {0, 0, 0}};
  s.run_for(2);
  EXPECT_LT((s.at().position - Vec3(3, 2, -6)).norm(), 1e-12);
}

TEST(PointMotionOnTerrain, TakesTimeToSpeedUpAlongTheGroundOnly) {
  const test::Hills hills = slope();
  PointOnHills s(hills, {{"height_above_ground", 1.0}, {"max_acceleration", 1.0}}, {});
  s.command() = {{4, 0, 0}, {0, 0, 0}};
  s.run_for(2);
  EXPECT_NEAR(s.twist(s.robot).linear.x(), 2, 1e-12);
}

}  // namespace
}  // namespace muro
