// SPDX-License-Identifier: MIT
#include "host/tools/compare/trajectory.hpp"

#include <gtest/gtest.h>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/bodies.hpp"

namespace muro::host {
namespace {

/// Two robots that stay where they are put.
struct Pair : test::Scene {
  const RobotView& a = add("a", test::single_body(Shape::sphere(0.1), {.mass = 1}));
  const RobotView& b = add("b", test::single_body(Shape::sphere(0.1), {.mass = 1}));
  Pair() {
    use("motion.point", 10, all_robots());
    build();
  }
  void put(const RobotView& robot, double x, double yaw = 0) { pose(robot) = {Vec3(x, 0, 0), from_rpy(0, 0, yaw)}; }
};

TEST(Trajectory, ItsDeviationIsTheRootOfTheMeanSquareOverTimeAndRobots) {
  Pair s;
  Trajectory reference({0, 1}), other({0, 1});
  for (int instant = 0; instant < 2; ++instant) {
    s.put(s.a, 0), s.put(s.b, 0);
    reference.sample(s);
    s.put(s.a, instant == 0 ? 0 : 3), s.put(s.b, instant == 0 ? 0 : -5);
    other.sample(s);
  }
  const Deviation d = deviation_of(other, reference);
  EXPECT_DOUBLE_EQ(d.position_rms, std::sqrt((9.0 + 25.0) / 4));
  EXPECT_DOUBLE_EQ(d.position_largest, 5);
  EXPECT_EQ(deviation_of(other, other).position_rms, 0);
  EXPECT_DOUBLE_EQ(other.distance(), 4) << "3 m and 5 m";
}

TEST(Trajectory, HeadingsOnBothSidesOfPiAreNear) {
  Pair s;
  Trajectory reference({0}), other({0});
  s.put(s.a, 0, 3.1);
  reference.sample(s);
  s.put(s.a, 0, -3.1);
  other.sample(s);
  EXPECT_NEAR(deviation_of(other, reference).heading_largest, 2 * M_PI - 6.2, 1e-12);
}

/// A mast with a jib that turns and a hook that slides along it, and a plate at its end.
RobotTree crane() {
  return test::tree_of([](RobotBuilder& b) {
    b.base("mast");
    b.translation({0, 0, 2});
    b.revolute("swing", Vec3::UnitZ(), {});
    b.body("jib");
    b.translation({1, 0, 0});
    b.prismatic("trolley", Vec3::UnitX(), {.lower = -1, .upper = 1});
    b.body("hook");
    b.translation({0, 0, -1});
    b.body("plate");
  });
}

TEST(Trajectory, JointsAndLinksDeviateWhereBasesDoNot) {
  test::Scene s;
  const RobotView& r = s.add("r", crane());
  s.use("motion.point", 10, s.all_robots());
  s.build();
  double &swing = s.world().value("r/swing", keys::joint_position),
         &trolley = s.world().value("r/trolley", keys::joint_position);
  Trajectory reference({0}), other({0});
  for (int instant = 0; instant < 2; ++instant) {
    swing = trolley = 0;
    reference.sample(s);
    swing = instant == 0 ? 0 : -M_PI / 2;
    trolley = instant == 0 ? 0.4 : 0;
    other.sample(s);
  }
  ASSERT_EQ(r.links.size(), 4u);
  const Deviation d = deviation_of(other, reference);
  EXPECT_EQ(d.position_largest, 0);
  ASSERT_TRUE(d.links && d.revolute_joints && d.prismatic_joints);
  EXPECT_DOUBLE_EQ(d.revolute_joints->largest, M_PI / 2);
  EXPECT_DOUBLE_EQ(d.revolute_joints->rms, M_PI / 2 / std::sqrt(2));
  EXPECT_DOUBLE_EQ(d.prismatic_joints->largest, 0.4);
  EXPECT_DOUBLE_EQ(d.prismatic_joints->rms, 0.4 / std::sqrt(2));
  // the jib turns on the spot; hook and plate are off by 0.4 m, then by a chord of a quarter of a turn at 1 m
  EXPECT_DOUBLE_EQ(d.links->largest, M_SQRT2);
  EXPECT_DOUBLE_EQ(d.links->rms, std::sqrt((2 * 0.16 + 2 * 2) / 6));
}

TEST(Trajectory, WithoutJointsOrLinksHasNoDeviationOfThem) {
  Pair s;
  Trajectory t({0, 1});
  t.sample(s);
  const Deviation d = deviation_of(t, t);
  EXPECT_FALSE(d.links || d.revolute_joints || d.prismatic_joints);
}

}  // namespace
}  // namespace muro::host
