// SPDX-License-Identifier: MIT
#include "orbit_camera.hpp"

#include <gtest/gtest.h>

#include "muro/toolkit/rotations.hpp"

namespace muro::view {
namespace {

/// Returns the position of a point in the picture: right and up, per metre ahead.
Eigen::Vector2d seen(const OrbitCamera& camera, const Vec3& at) {
  const Vec3 p = camera.pose().inverse() * at;
  return {-p.y() / p.x(), p.z() / p.x()};
}

TEST(AnOrbitCamera, LooksWhereItIsTold) {
  OrbitCamera camera;
  camera.look_from({3, -2, 5}, {1, 1, 0});
  EXPECT_NEAR((camera.pose().position - Vec3(3, -2, 5)).norm(), 0, 1e-12);
  EXPECT_NEAR(seen(camera, {1, 1, 0}).norm(), 0, 1e-12);
  EXPECT_GT(seen(camera, {1, 1, 1}).y(), 0) << "up is up";
}

TEST(AnOrbitCamera, SeesAllOfWhatItIsToSee) {
  OrbitCamera camera;
  const Vec3 low(-4, 2, 0), high(9, 7, 2);
  camera.show_box(low, high);
  for (int k = 0; k < 8; ++k) {
    const Vec3 corner(k & 1 ? low.x() : high.x(), k & 2 ? low.y() : high.y(), k & 4 ? low.z() : high.z());
    EXPECT_LT(std::abs(seen(camera, corner).y()), std::tan(0.45) * 1.3);
  }
}

TEST(AnOrbitCamera, TurnsAroundWhatItLooksAt) {
  OrbitCamera camera;
  camera.look_from({5, 0, 1}, {0, 0, 1});
  camera.rotate(200, 0, 800);
  EXPECT_NEAR((camera.pose().position - Vec3(0, 0, 1)).norm(), 5, 1e-12);
  EXPECT_NEAR(seen(camera, {0, 0, 1}).norm(), 0, 1e-12);
  EXPECT_LT(camera.pose().position.y(), -3) << "the scene turns with the mouse";
  camera.rotate(0, 1e6, 800);
  EXPECT_GT(camera.pose().position.z(), 5.9) << "from above, and no further";
}

TEST(AnOrbitCamera, ShiftsTheSceneWithTheMouse) {
  OrbitCamera camera;
  camera.look_from({5, 0, 1}, {0, 0, 1});
  const double fov = 0.9, height = 800;
  camera.shift(100, 50, height, fov);
  const Eigen::Vector2d moved = seen(camera, {0, 0, 1}) * (0.5 * height / std::tan(0.5 * fov));
  EXPECT_NEAR(moved.x(), 100, 1e-6);
  EXPECT_NEAR(moved.y(), -50, 1e-6);
}

TEST(AnOrbitCamera, ComesNearerByTheWheel) {
  OrbitCamera camera;
  camera.look_from({5, 0, 1}, {0, 0, 1});
  camera.zoom(3);
  EXPECT_NEAR(camera.distance(), 5 * std::pow(0.85, 3), 1e-12);
}

TEST(AnOrbitCamera, FollowsWithoutTurning) {
  OrbitCamera camera;
  camera.look_from({5, 0, 1}, {0, 0, 1});
  camera.mode = OrbitCamera::Mode::follow;
  const Quat before = camera.pose().orientation;
  camera.follow({{7, 8, 1}, from_rpy(0, 0, 2)});
  EXPECT_NEAR((camera.pose().position - Vec3(12, 8, 1)).norm(), 0, 1e-12);
  EXPECT_EQ(camera.pose().orientation.coeffs(), before.coeffs());
}

TEST(AnOrbitCamera, StaysWithATeamFromItsOwnDirection) {
  OrbitCamera camera;
  camera.look_from({5, 0, 1}, {0, 0, 1});
  const Quat before = camera.pose().orientation;
  camera.approach({8, 4, 1}, 3, 1, true);
  EXPECT_NEAR((camera.pose().position - Vec3(13, 4, 1)).norm(), 0, 1e-12) << "at the distance that the user has chosen";
  camera.approach({8, 4, 1}, 3, 1, false);
  EXPECT_EQ(camera.pose().orientation.coeffs(), before.coeffs());
  for (const Vec3& edge : {Vec3(8, 1, 1), Vec3(8, 7, 1), Vec3(8, 4, 4), Vec3(8, 4, -2)})
    EXPECT_LT(seen(camera, edge).norm(), std::tan(0.45)) << "all of it is in the picture";
  camera.look_from({5, 0, 1}, {0, 0, 1});
  camera.approach({8, 4, 1}, 3, 0.25, true);
  EXPECT_NEAR((camera.target() - Vec3(2, 1, 1)).norm(), 0, 1e-12) << "a quarter of the way";
}

TEST(AnOrbitCamera, SeesAsItsCarrierDoes) {
  OrbitCamera camera;
  camera.mode = OrbitCamera::Mode::first_person;
  const Pose carrier{{7, 8, 1}, from_rpy(0.1, 0.2, 2)};
  camera.follow(carrier);
  EXPECT_EQ(camera.pose().position, carrier.position);
  EXPECT_EQ(camera.pose().orientation.coeffs(), carrier.orientation.coeffs());
}

}  // namespace
}  // namespace muro::view
