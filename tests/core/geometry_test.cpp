// SPDX-License-Identifier: MIT
// Functions that geometry.hpp writes out in numbers, compared with Eigen's matrices.
#include <gtest/gtest.h>

#include <random>

#include "muro/geometry.hpp"
#include "muro/toolkit/rotations.hpp"

namespace muro {
namespace {

struct Dice {
  std::mt19937 engine{7};
  double number(double low = -1, double high = 1) { return std::uniform_real_distribution(low, high)(engine); }
  Vec3 vector() { return {number(), number(), number()}; }
  Vec3 direction() { return vector().normalized(); }
  Quat turn() { return Quat(Eigen::AngleAxisd(number(-3, 3), direction())); }
  Inertia inertia() {
    const Mat3 axes = turn().toRotationMatrix();
    return Inertia::from(number(0.1, 3), vector(), axes * Vec3(1, 1.4, 1.9).asDiagonal() * axes.transpose());
  }
};

Mat3 matrix_of(const Vec3& v) {
  Mat3 m;
  m << 0, -v.z(), v.y(), v.z(), 0, -v.x(), -v.y(), v.x(), 0;
  return m;
}

TEST(AnInertia, IsTheSameBodyInAnotherFrame) {
  Dice dice;
  for (int i = 0; i < 100; ++i) {
    const Inertia body = dice.inertia();
    const Pose pose{dice.vector(), dice.turn()};
    const Mat3 r = pose.orientation.toRotationMatrix();
    const Inertia moved = body.in(pose);
    EXPECT_EQ(moved.mass, body.mass);
    EXPECT_TRUE(moved.com.isApprox(r * body.com + pose.position, 1e-14));
    EXPECT_TRUE(moved.tensor().isApprox(r * body.tensor() * r.transpose(), 1e-13));
  }
}

TEST(AnInertia, IsMovedByTheParallelAxisTheorem) {
  Dice dice;
  for (int i = 0; i < 100; ++i) {
    const Inertia body = dice.inertia();
    const Vec3 centre = dice.vector();
    const Mat3 arm = matrix_of(body.com - centre);
    EXPECT_TRUE(body.about(centre).isApprox(body.tensor() - body.mass * arm * arm, 1e-13));
  }
}

TEST(TwoInertias, HaveTheSumsOfTheirMomentsAboutEveryPoint) {
  Dice dice;
  for (int i = 0; i < 100; ++i) {
    const Inertia a = dice.inertia(), b = dice.inertia(), whole = a + b;
    const Vec3 centre = dice.vector();
    EXPECT_DOUBLE_EQ(whole.mass, a.mass + b.mass);
    EXPECT_TRUE((whole.mass * whole.com).isApprox(a.mass * a.com + b.mass * b.com, 1e-13));
    EXPECT_TRUE(whole.about(centre).isApprox(a.about(centre) + b.about(centre), 1e-13));
  }
}

TEST(RollPitchYaw, AreTurnsAboutFixedAxes) {
  Dice dice;
  for (int i = 0; i < 100; ++i) {
    const double roll = dice.number(-3, 3), pitch = dice.number(-3, 3), yaw = dice.number(-3, 3);
    const Mat3 turn = (Eigen::AngleAxisd(yaw, Vec3::UnitZ()) * Eigen::AngleAxisd(pitch, Vec3::UnitY()) *
                       Eigen::AngleAxisd(roll, Vec3::UnitX()))
                          .toRotationMatrix();
    EXPECT_TRUE(from_rpy(roll, pitch, yaw).toRotationMatrix().isApprox(turn, 1e-14));
  }
}

TEST(AScrew, IsTheMeanOfItsTurns) {
  Dice dice;
  for (const double size : {1e-5, 1e-3, 0.1, 1.0, 3.0}) {
    const Vec3 v = size * dice.direction();
    Mat3 sum = Mat3::Zero();
    const int parts = 2000;
    for (int i = 0; i < parts; ++i)
      sum += Eigen::AngleAxisd((i + 0.5) / parts * v.norm(), v.normalized()).toRotationMatrix() / parts;
    EXPECT_TRUE(screw_integral(v).isApprox(sum, 1e-6)) << size;
  }
}

TEST(TheTurnBetweenDirections, IsTheShortest) {
  Dice dice;
  for (int i = 0; i < 300; ++i) {
    const Vec3 from = i % 3 == 0 ? Vec3(Vec3::Unit(i % 9 / 3)) : dice.direction();
    const Vec3 to = i % 5 == 0 ? Vec3(-from) : i % 5 == 1 ? from : dice.direction();
    const Quat turn = turn_between(from, to);
    EXPECT_NEAR(turn.norm(), 1, 1e-14);
    EXPECT_TRUE((turn * from).isApprox(to, 1e-7)) << from.transpose() << " to " << to.transpose();
    EXPECT_NEAR(turn.angularDistance(Quat::Identity()), std::acos(std::clamp(from.dot(to), -1.0, 1.0)), 1e-7);
  }
}

}  // namespace
}  // namespace muro
