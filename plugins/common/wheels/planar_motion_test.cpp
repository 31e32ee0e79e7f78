// SPDX-License-Identifier: MIT
#include "planar_motion.hpp"

#include <gtest/gtest.h>

#include "muro/toolkit/rotations.hpp"
#include "tests/support/randoms.hpp"

namespace muro::wheels {
namespace {

/// Returns the displacement of a frame by Simpson's rule over many small intervals.
Vec3 simpson(const PlanarTwist& v, const PlanarTwist& acceleration, double dt) {
  const int n = 20000;
  Vec3 sum = Vec3::Zero();
  for (int i = 0; i <= n; ++i) {
    const double t = dt * i / n, heading = v.yaw_rate * t + 0.5 * acceleration.yaw_rate * t * t;
    const PlanarTwist now = v + acceleration * t;
    const Vec3 f = Eigen::AngleAxisd(heading, Vec3::UnitZ()) * Vec3(now.x, now.y, 0);
    sum += (i == 0 || i == n ? 1 : i % 2 == 1 ? 4 : 2) * f;
  }
  return sum * dt / (3 * n);
}

TEST(Arc, IsACircleOfTheRadiusOfSpeedByTurnRate) {
  for (const double turn : {-4.0, -1.0, 0.3, 1.0, 2.0, 7.0}) {
    const Pose end = arc({1.5, 0, turn}, 0.8);
    const double radius = 1.5 / turn, angle = 0.8 * turn;
    EXPECT_NEAR(end.position.x(), radius * std::sin(angle), 1e-15);
    EXPECT_NEAR(end.position.y(), radius * (1 - std::cos(angle)), 1e-15);
    EXPECT_EQ(end.position.z(), 0);
    EXPECT_NEAR(std::remainder(yaw_of(end.orientation) - angle, 2 * M_PI), 0, 1e-15);
  }
}

TEST(Arc, BecomesAStraightLineAsTheTurnVanishes) {
  EXPECT_EQ(arc({2, 0, 0}, 0.5).position, Vec3(1, 0, 0));
  for (double turn = 1e-3; turn > 1e-300; turn *= 1e-3) {
    const Vec3 end = arc({2, 0, turn}, 0.5).position;
    EXPECT_NEAR(end.x(), 1, turn * turn);
    EXPECT_NEAR(end.y(), 0.25 * turn, 1e-2 * turn * turn + 1e-300);
  }
}

TEST(Arc, TwoArcsOfHalfTheTimeAreOne) {
  test::Randoms draw(1);
  for (int i = 0; i < 100; ++i) {
    const PlanarTwist v{draw.uniform(-2, 2), draw.uniform(-2, 2), draw.uniform(-5, 5)};
    const Pose once = arc(v, 1), half = arc(v, 0.5), both = half * half;
    EXPECT_LT((once.position - both.position).norm(), 1e-15);
    EXPECT_LT((once.orientation.coeffs() - both.orientation.coeffs()).norm(), 1e-15);
  }
}

TEST(AcceleratedArc, IsTheIntegralOfAVelocityThatChangesEvenly) {
  test::Randoms draw(2);
  for (int i = 0; i < 30; ++i) {
    const PlanarTwist v{draw.uniform(-2, 2), draw.uniform(-2, 2), draw.uniform(-1, 1)},
        acceleration{draw.uniform(-2, 2), draw.uniform(-2, 2), draw.uniform(-1, 1)};
    const Pose end = accelerated_arc(v, acceleration, 0.6);
    EXPECT_LT((end.position - simpson(v, acceleration, 0.6)).norm(), 1e-10);
    EXPECT_NEAR(yaw_of(end.orientation), 0.6 * v.yaw_rate + 0.18 * acceleration.yaw_rate, 1e-15);
  }
}

TEST(AcceleratedArc, WithoutChangeIsAnArc) {
  test::Randoms draw(3);
  for (int i = 0; i < 30; ++i) {
    const PlanarTwist v{draw.uniform(-2, 2), draw.uniform(-2, 2), draw.uniform(-2, 2)};
    EXPECT_LT((accelerated_arc(v, {}, 0.5).position - arc(v, 0.5).position).norm(), 1e-11);
  }
}

}  // namespace
}  // namespace muro::wheels
