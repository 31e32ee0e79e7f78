// SPDX-License-Identifier: MIT
#include "host/compare/trajectory.hpp"

#include <gtest/gtest.h>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/bodies.hpp"

namespace muro::host {
namespace {

/// Two robots that stand where they are put.
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

}  // namespace
}  // namespace muro::host
