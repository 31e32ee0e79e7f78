// SPDX-License-Identifier: MIT
#include "eye.hpp"

#include <gtest/gtest.h>

namespace muro::view {
namespace {

/// Where something is in the picture: right and up, per metre ahead.
Eigen::Vector2d seen(const Eye& eye, const Vec3& at) {
  const Vec3 p = eye.pose().inverse() * at;
  return {-p.y() / p.x(), p.z() / p.x()};
}

TEST(AnEye, LooksWhereItIsTold) {
  Eye eye;
  eye.look_from({3, -2, 5}, {1, 1, 0});
  EXPECT_NEAR((eye.pose().position - Vec3(3, -2, 5)).norm(), 0, 1e-12);
  EXPECT_NEAR(seen(eye, {1, 1, 0}).norm(), 0, 1e-12);
  EXPECT_GT(seen(eye, {1, 1, 1}).y(), 0) << "up is up";
}

TEST(AnEye, SeesAllOfWhatItIsToSee) {
  Eye eye;
  const Vec3 low(-4, 2, 0), high(9, 7, 2);
  eye.look_at_all(low, high);
  for (int k = 0; k < 8; ++k) {
    const Vec3 corner(k & 1 ? low.x() : high.x(), k & 2 ? low.y() : high.y(), k & 4 ? low.z() : high.z());
    EXPECT_LT(std::abs(seen(eye, corner).y()), std::tan(0.45) * 1.3);
  }
}

TEST(AnEye, TurnsAroundWhatItLooksAt) {
  Eye eye;
  eye.look_from({5, 0, 1}, {0, 0, 1});
  eye.turn(200, 0, 800);
  EXPECT_NEAR((eye.pose().position - Vec3(0, 0, 1)).norm(), 5, 1e-12);
  EXPECT_NEAR(seen(eye, {0, 0, 1}).norm(), 0, 1e-12);
  EXPECT_LT(eye.pose().position.y(), -3) << "the scene turns with the mouse";
  eye.turn(0, 1e6, 800);
  EXPECT_GT(eye.pose().position.z(), 5.9) << "from above, and no further";
}

TEST(AnEye, ShiftsTheSceneWithTheMouse) {
  Eye eye;
  eye.look_from({5, 0, 1}, {0, 0, 1});
  const double fov = 0.9, height = 800;
  eye.shift(100, 50, height, fov);
  const Eigen::Vector2d moved = seen(eye, {0, 0, 1}) * (0.5 * height / std::tan(0.5 * fov));
  EXPECT_NEAR(moved.x(), 100, 1e-6);
  EXPECT_NEAR(moved.y(), -50, 1e-6);
}

TEST(AnEye, ComesNearerByTheWheel) {
  Eye eye;
  eye.look_from({5, 0, 1}, {0, 0, 1});
  eye.zoom(3);
  EXPECT_NEAR(eye.distance(), 5 * std::pow(0.85, 3), 1e-12);
}

TEST(AnEye, FollowsWithoutTurning) {
  Eye eye;
  eye.look_from({5, 0, 1}, {0, 0, 1});
  eye.mode = Eye::Mode::follow;
  const Quat before = eye.pose().orientation;
  eye.follow({{7, 8, 1}, from_rpy(0, 0, 2)});
  EXPECT_NEAR((eye.pose().position - Vec3(12, 8, 1)).norm(), 0, 1e-12);
  EXPECT_EQ(eye.pose().orientation.coeffs(), before.coeffs());
}

TEST(AnEye, SeesAsItsCarrierDoes) {
  Eye eye;
  eye.mode = Eye::Mode::first_person;
  const Pose carrier{{7, 8, 1}, from_rpy(0.1, 0.2, 2)};
  eye.follow(carrier);
  EXPECT_EQ(eye.pose().position, carrier.position);
  EXPECT_EQ(eye.pose().orientation.coeffs(), carrier.orientation.coeffs());
}

}  // namespace
}  // namespace muro::view
