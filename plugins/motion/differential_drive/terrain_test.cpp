// SPDX-License-Identifier: MIT
// Tests of vehicles with wheels on both sides on heightmaps: closed forms of the positions of their wheels.
#include <gtest/gtest.h>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/hills.hpp"
#include "tests/support/wheeled_robot.hpp"

namespace muro {
namespace {

using test::Hills;
using Settings = std::map<std::string, ParameterInput>;

constexpr double radius = 0.1, half_length = 0.25, half_width = 0.2;

const std::vector<Vec3>& four_places() {
  static const std::vector<Vec3> places{{half_length, half_width, 0},
                                        {half_length, -half_width, 0},
                                        {-half_length, half_width, 0},
                                        {-half_length, -half_width, 0}};
  return places;
}

RobotTree four_wheeler() {
  std::vector<test::WheelPart> wheels;
  for (const char* name : {"front_left", "front_right", "rear_left", "rear_right"})
    wheels.push_back({.name = name, .at = four_places()[wheels.size()], .radius = radius});
  return test::wheeled_robot(wheels);
}

/// A vehicle with two wheels and the ball of a caster behind them.
RobotTree two_wheels_and_a_caster() {
  return test::wheeled_robot({{.name = "left", .at = {0, half_width, 0}, .radius = radius},
                              {.name = "right", .at = {0, -half_width, 0}, .radius = radius}},
                             [](RobotBuilder& b) {
                               const Shape ball = Shape::sphere(0.04);
                               b.translation({-0.3, 0, -0.06});
                               b.revolute("caster_joint", Vec3::UnitX(), {});
                               b.body("caster");
                               b.set_array(keys::collision_shapes, std::span<const Shape>(&ball, 1));
                             });
}

/// A vehicle on hills.
struct OnHills : test::Scene {
  const RobotView& robot;
  OnHills(const Hills& hills, double rate, const RobotTree& tree, const Pose& start = {}, const Settings& settings = {},
          const Pose& hills_at = {}, bool touches = false, const std::vector<Shape>& walls = {})
      : robot((hills.add_to(*this, hills_at, walls), add("rover", tree, start))) {
    use("motion.differential_drive", rate, all_robots(), settings);
    if (touches) {
      use_kinematics();
      use("scene.bvh", 0);
      use("collision.native", 0);
    }
    build();
  }
  /// Drives all wheels of a side with its speed (rad/s).
  void drive(double left, double right) {
    for (const Link& link : robot.links) {
      if (link.joint != JointKind::revolute) continue;
      const std::string joint(world().object_name(link.joint_object));
      if (joint.find("left") != std::string::npos) world().value(joint, keys::joint_velocity_target) = left;
      if (joint.find("right") != std::string::npos) world().value(joint, keys::joint_velocity_target) = right;
    }
  }
  Pose& at() { return pose(robot); }
  Vec3 lowest(const Vec3& wheel) { return at() * Vec3(wheel - Vec3(0, 0, radius)); }
  double yaw() { return yaw_of(at().orientation); }
};

TEST(DifferentialDriveOnTerrain, AnInclinedPlaneOfHeightsIsThatPlane) {
  const Hills hills(32, 64, [](double x, double y) { return 0.25 * x - 0.125 * y; });
  for (const double rate : {10.0, 100.0}) {
    OnHills s(hills, rate, two_wheels_and_a_caster(), {{1, -2, 7}, from_rpy(0, 0, 0.7)});
    const Pose start = s.at();
    for (const Vec3& point : {Vec3(0, half_width, -radius), Vec3(0, -half_width, -radius), Vec3(-0.3, 0, -radius)}) {
      const Vec3 on_ground = start * point;
      EXPECT_NEAR(on_ground.z(), 0.25 * on_ground.x() - 0.125 * on_ground.y(), 1e-12);
    }
    EXPECT_NEAR(s.yaw(), 0.7, 1e-12);
    s.drive(8, 10);
    s.run_for(10);
    const Pose in_plane = start.inverse() * s.at();  // v 0.9 m/s, turning by 0.5 rad/s: a circle of 1.8 m
    EXPECT_LT((in_plane.position - Vec3(1.8 * std::sin(5), 1.8 * (1 - std::cos(5)), 0)).norm(), 1e-9) << rate << " Hz";
    EXPECT_NEAR(std::remainder(yaw_of(in_plane.orientation) - 5, 2 * M_PI), 0, 1e-9);
    EXPECT_NEAR((in_plane.orientation * Vec3::UnitZ()).z(), 1, 1e-12);
    EXPECT_LT((s.twist(s.robot).linear - 0.9 * (s.at().orientation * Vec3::UnitX())).norm(), 1e-9);
    EXPECT_LT((s.twist(s.robot).angular - 0.5 * (s.at().orientation * Vec3::UnitZ())).norm(), 1e-9);
  }
}

TEST(DifferentialDriveOnTerrain, ATiltedHeightmapIsAnInclinedPlaneToo) {
  const Hills hills(32, 16, [](double, double) { return 0.5; });
  const Pose tilted{{0, 0, 1}, from_rpy(0.2, -0.3, 0.4)};
  OnHills s(hills, 100, four_wheeler(), {{1, -2, 0}, from_rpy(0, 0, 0.7)}, {}, tilted);
  s.drive(5, 9);
  s.run_for(4);
  for (const Vec3& wheel : four_places())
    EXPECT_NEAR((tilted.inverse() * s.lowest(wheel)).z(), 0.5, 1e-9) << wheel.transpose();
}

/// Returns the distance (m) of a point from the curve z = sin(x) / 2.
double distance_from_sine(double x, double z) {
  double nearest = 1e9;
  for (double at = x - 0.3; at < x + 0.3; at += 1e-4)
    nearest = std::min(nearest, std::hypot(at - x, 0.5 * std::sin(at) - z));
  return nearest;
}

TEST(DifferentialDriveOnTerrain, WheelsTouchASineHillAndRollAlongIt) {
  const Hills hills(32, 640, [](double x, double) { return 0.5 * std::sin(x); });
  OnHills s(hills, 100, four_wheeler(), {{-2 * M_PI, 0, 0}, Quat::Identity()});
  s.drive(10, 10);
  double furthest = 0;
  while (s.at().position.x() < 2 * M_PI) {
    s.run_for(0.1);
    EXPECT_NEAR(s.yaw(), 0, 1e-12);
    EXPECT_NEAR(s.at().position.y(), 0, 1e-9);
    for (const Vec3& wheel : four_places()) {
      const Vec3 axle = s.at() * wheel;
      // The lowest point of a wheel is taken along the normal of the base, not of the ground. These normals differ by
      // up to half a wheelbase times the curvature of 0.5 / m. Sagitta of the cells: 0.16 mm.
      const double turn = 0.5 * half_length;
      EXPECT_NEAR(distance_from_sine(axle.x(), axle.z()), radius, 0.5 * radius * turn * turn + 2e-4);
    }
    furthest = s.at().position.x();
  }
  double surface = 0;
  for (double x = -2 * M_PI; x < furthest; x += 1e-4) surface += 1e-4 * std::hypot(1, 0.5 * std::cos(x));
  const double rolled = radius * s.world().value("rover/front_left_joint", keys::joint_position);
  // the middle between the axles is below the ground by the sagitta of the wheelbase, 8 mm at most
  EXPECT_NEAR(rolled / surface, 1, 0.5 * 0.5 * half_length * half_length * 0.5)
      << "the way is measured along the ground";
}

TEST(DifferentialDriveOnTerrain, FourWheelsOnTwistedGroundStandByLeastSquares) {
  // Opposite corners are equally high: a level base misses each by the same distance, and no tilt reduces it.
  const Hills hills(8, 16, [](double x, double y) { return 0.5 * x * y; });
  const RobotTree tree = test::wheeled_robot({{.name = "front_left", .at = {0.5, 0.5, 0}},
                                              {.name = "front_right", .at = {0.5, -0.5, 0}},
                                              {.name = "rear_left", .at = {-0.5, 0.5, 0}},
                                              {.name = "rear_right", .at = {-0.5, -0.5, 0}}});
  OnHills s(hills, 10, tree, {{0, 0, 3}, Quat::Identity()});
  EXPECT_NEAR(s.at().position.z(), 0.05, 1e-9);
  EXPECT_NEAR(s.at().orientation.angularDistance(Quat::Identity()), 0, 1e-7);
}

TEST(DifferentialDriveOnTerrain, TwistIsTheDerivativeOfPose) {
  const Hills hills(32, 64, [](double x, double y) { return 0.4 * std::sin(x) * std::cos(0.7 * y); });
  OnHills s(hills, 1e4, two_wheels_and_a_caster(), {{1, -2, 0}, from_rpy(0, 0, 0.7)});
  s.drive(7, 8);
  for (int i = 0; i < 20; ++i) {
    s.run_for(0.1);
    const Pose before = s.at();
    const Twist v = s.twist(s.robot);
    s.run_for(1e-4);
    const Twist after = s.twist(s.robot);
    if ((after.angular - v.angular).norm() > 0.01) continue;  // a point has entered another cell
    EXPECT_LT(((s.at().position - before.position) / 1e-4 - v.linear).norm(), 1e-3) << i;
    EXPECT_LT((rotation_vector_of(s.at().orientation * before.orientation.conjugate()) / 1e-4 - v.angular).norm(), 1e-3)
        << i;
  }
}

TEST(DifferentialDriveOnTerrain, BeyondTheRimTheHeightOfTheLastGroundIsKept) {
  const Hills hills(8, 16, [](double x, double) { return 0.25 * x; });
  OnHills s(hills, 100, four_wheeler(), {{3, 0.1, 0}, Quat::Identity()});
  s.drive(10, 10);
  s.run_for(4);
  EXPECT_GT(s.at().position.x(), 6);
  EXPECT_NEAR(s.at().position.z(), 1 + radius, 3e-3) << "1 m at the rim, left within a step of 1 cm";
  EXPECT_NEAR((s.at().orientation * Vec3::UnitZ()).z(), 1, 1e-4);
  const double height = s.at().position.z();
  s.run_for(1);
  EXPECT_NEAR(s.at().position.z(), height, 1e-9);
}

TEST(DifferentialDriveOnTerrain, APlaneAboveHollowsIsTheGround) {
  const Hills hills(16, 32, [](double x, double) { return 0.25 * x; });
  test::Scene s;
  hills.add_to(s);
  s.add_ground();
  const RobotView& low = s.add("low", four_wheeler(), {{-3, 0, 0}, Quat::Identity()});
  const RobotView& high = s.add("high", four_wheeler(), {{3, 0, 0}, Quat::Identity()});
  s.use("motion.differential_drive", 10, s.all_robots());
  s.build();
  EXPECT_NEAR(s.pose(low).position.z(), radius, 1e-12);
  EXPECT_NEAR((s.pose(low).orientation * Vec3::UnitZ()).z(), 1, 1e-12);
  EXPECT_GT(s.pose(high).position.z(), 0.75);
}

TEST(DifferentialDriveOnTerrain, ARobotPutAnywhereStandsOnTheGroundAfterAStep) {
  const Hills hills(32, 64, [](double x, double) { return 0.25 * x; });
  OnHills s(hills, 100, four_wheeler());
  s.at() = {{2, 3, 40}, from_rpy(-0.2, 0.5, 1.1)};
  s.run_for(0.01);
  for (const Vec3& wheel : four_places()) EXPECT_NEAR(s.lowest(wheel).z(), 0.25 * s.lowest(wheel).x(), 1e-12);
  EXPECT_NEAR(s.yaw(), 1.1, 1e-12);
}

TEST(DifferentialDriveOnTerrain, ARobotThatLiesStaysAsItIs) {
  const Hills hills(32, 64, [](double x, double) { return 0.25 * x; });
  const Pose on_its_roof{{2, 3, 4}, from_rpy(M_PI, 0, 0)};
  OnHills s(hills, 100, four_wheeler(), on_its_roof);
  s.run_for(0.1);
  EXPECT_EQ(s.at().position, on_its_roof.position);
}

TEST(DifferentialDriveOnTerrain, GoesOnFromASnapshotToTheSameBits) {
  const Hills hills(32, 64, [](double x, double y) { return 0.4 * std::sin(x) * std::cos(0.7 * y); });
  OnHills s(hills, 100, four_wheeler());
  s.drive(7, 9);
  s.run_for(1.23);
  const Snapshot snapshot = s.snapshot();
  s.run_for(2);
  const std::uint64_t end = s.state_hash();
  s.restore(snapshot);
  s.run_for(2);
  EXPECT_EQ(s.state_hash(), end);
}

TEST(DifferentialDriveOnTerrain, LongStepsFollowTheHillsAsShortOnesDo) {
  const Hills hills(32, 128, [](double x, double y) { return 0.4 * std::sin(x) * std::cos(0.7 * y); });
  Vec3 end[2];
  for (const int i : {0, 1}) {
    OnHills s(hills, i == 0 ? 1 : 500, four_wheeler());
    s.drive(9, 10);
    s.run_for(6);
    end[i] = s.at().position;
  }
  EXPECT_LT((end[0] - end[1]).norm(), 0.05) << "of a way of 5.7 m in steps of 0.95 m";
}

TEST(DifferentialDriveOnTerrain, SlopesDoNotStopWhatStopsOnContact) {
  const Hills hills(32, 64, [](double x, double) { return 0.5 * std::sin(x); });
  OnHills free(hills, 100, four_wheeler());
  OnHills s(hills, 100, four_wheeler(), {}, {{"on_contact", std::string("stop")}}, {}, true);
  free.drive(10, 10), s.drive(10, 10);
  int against = 0;
  for (int i = 0; i < 500; ++i) {
    free.run_for(0.01), s.run_for(0.01);
    const Twist moving = s.twist(s.robot);
    for (const Contact& c : s.world().values(s.robot.base(), keys::contacts)) {
      const Vec3 velocity = moving.at(c.point - s.at().position);
      against += velocity.dot(c.normal) < -0.03 * velocity.norm();
    }
  }
  EXPECT_GT(against, 0) << "where cells meet, a wheel touches the next one: scenery so steep would have stopped it";
  EXPECT_EQ(s.at().position, free.at().position);
}

TEST(DifferentialDriveOnTerrain, AWallOfOneObjectWithTheGroundStopsWhatStopsOnContact) {
  const Hills flat(32, 4, [](double, double) { return 0.0; });
  Shape wall = Shape::box({0.2, 4, 1});
  wall.origin.position = {2, 0, 0.5};
  OnHills s(flat, 100, four_wheeler(), {}, {{"on_contact", std::string("stop")}}, {}, true, {wall});
  s.drive(10, 10);
  s.run_for(5);
  EXPECT_GT(s.at().position.x(), 1);
  EXPECT_LT(s.at().position.x(), 1.9);
}

}  // namespace
}  // namespace muro
