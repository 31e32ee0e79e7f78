// SPDX-License-Identifier: MIT
#include "sole.hpp"

#include <gtest/gtest.h>

#include <random>

#include "muro/toolkit/rotations.hpp"

namespace muro::biped {
namespace {

class Draw {
 public:
  double number(double low, double high) { return std::uniform_real_distribution<double>(low, high)(engine_); }
  Vec3 vector() { return {number(-1, 1), number(-1, 1), number(-1, 1)}; }
  Quat turn() { return rotation_of(3 * vector()); }

 private:
  std::mt19937 engine_{7};
};

std::vector<SolePoint> box(const Vec3& half, const Pose& at) {
  std::vector<SolePoint> points;
  for (const double x : {-half.x(), half.x()})
    for (const double y : {-half.y(), half.y()})
      for (const double z : {-half.z(), half.z()}) points.push_back({.center = at * Vec3(x, y, z)});
  return points;
}

TEST(ASole, OfABoxIsItsFaceThatLooksDownMost) {
  Draw draw;
  for (int round = 0; round < 200; ++round) {
    const Pose at{draw.vector(), draw.turn()};
    const Vec3 tilted = (Vec3(0, 0, -1) + 0.3 * draw.vector()).normalized();
    const Sole sole(box({0.1, 0.05, 0.02}, at), at.orientation * tilted);
    ASSERT_EQ(sole.side(), Sole::Side::face);
    ASSERT_LT((sole.normal() - at.orientation * Vec3(0, 0, -1)).norm(), 1e-9) << "round " << round;
  }
}

TEST(ASole, OfACylinderOnEndIsItsDisc) {
  const Vec3 axis = Vec3(0.1, 0.2, 1).normalized();
  const Sole sole({{.center = {0, 0, 0}, .rim = 0.05, .axis = axis}, {.center = 0.1 * axis, .rim = 0.05, .axis = axis}},
                  -Vec3::UnitZ());
  EXPECT_EQ(sole.side(), Sole::Side::face);
  EXPECT_LT((sole.normal() + axis).norm(), 1e-9);
}

TEST(ASole, OfABallHasNoSideAndOfACapsuleAnEdge) {
  const Sole ball({{.center = {0, 0, 1}, .radius = 0.2}}, -Vec3::UnitZ());
  EXPECT_EQ(ball.side(), Sole::Side::none);
  EXPECT_NEAR(ball.lowest(Vec3(0.6, 0, 0.8)), 0.6, 1e-15);
  EXPECT_EQ(ball.flush_turn(Quat::Identity(), Vec3::UnitZ()).w(), 1);
  const Sole capsule({{.center = {-0.1, 0, 0}, .radius = 0.02}, {.center = {0.1, 0, 0}, .radius = 0.02}},
                     -Vec3::UnitZ());
  EXPECT_EQ(capsule.side(), Sole::Side::edge);
  const Quat tilted = rotation_about(Vec3::UnitX(), 0.5) * rotation_about(Vec3::UnitY(), 0.3);
  const Quat flat = capsule.flush_turn(tilted, Vec3::UnitZ()) * tilted;
  EXPECT_NEAR((flat * Vec3::UnitX()).z(), 0, 1e-15);
  EXPECT_NEAR(flat.angularDistance(tilted), std::asin(std::abs((tilted * Vec3::UnitX()).z())), 1e-12) << "no more";
}

TEST(ASole, IsAsLowAsTheLowestOfAllThatItIsMadeOf) {
  Draw draw;
  for (int round = 0; round < 50; ++round) {
    const Vec3 axis = draw.vector().normalized(), up = draw.vector().normalized();
    const SolePoint disc{.center = draw.vector(), .rim = 0.3, .axis = axis};
    const SolePoint ball{.center = draw.vector(), .radius = 0.2};
    const Sole sole({disc, ball}, -Vec3::UnitZ());
    double least = up.dot(ball.center) - 0.2;
    const Vec3 across = axis.unitOrthogonal();
    for (int i = 0; i < 20000; ++i)
      least = std::min(least, up.dot(disc.center + 0.3 * (Eigen::AngleAxisd(2 * M_PI * i / 20000, axis) * across)));
    ASSERT_NEAR(sole.lowest(up), least, 1e-7);
    ASSERT_NEAR(up.dot(sole.lowest_point(up)), sole.lowest(up), 1e-12);
  }
}

TEST(ASole, LiesFlatAfterTheSmallestTurn) {
  Draw draw;
  for (int round = 0; round < 100; ++round) {
    const Sole sole(box({0.1, 0.05, 0.02}, {}), -Vec3::UnitZ());
    const Quat foot = draw.turn();
    const Vec3 normal = draw.vector().normalized();
    const Quat turn = sole.flush_turn(foot, normal), flat = turn * foot;
    const Vec3 up = flat.conjugate() * normal;
    ASSERT_LT((up - Vec3::UnitZ()).norm(), 1e-9);
    ASSERT_NEAR(angle_of(turn), std::acos(std::clamp((foot * Vec3::UnitZ()).dot(normal), -1.0, 1.0)), 1e-7);
  }
}

}  // namespace
}  // namespace muro::biped
