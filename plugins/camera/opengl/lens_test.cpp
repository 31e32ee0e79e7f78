// SPDX-License-Identifier: MIT
#include "lens.hpp"

#include <gtest/gtest.h>

namespace muro::camera {
namespace {

/// Distortion of a cheap wide-angle camera, as OpenCV's calibration gives it.
constexpr Distortion webcam{-0.35, 0.15, 0.001, -0.0008, -0.03};

TEST(ALens, BendsRaysAsBrownsEquationsSay) {
  const Distortion k1{.k1 = -0.2};
  EXPECT_NEAR(k1.distorted({0.5, 0}).x(), 0.5 * (1 - 0.2 * 0.25), 1e-15);
  const Distortion tangential{.p1 = 0.01, .p2 = 0.02};
  const Eigen::Vector2d p = tangential.distorted({0.3, 0.4});
  EXPECT_NEAR(p.x(), 0.3 + 2 * 0.01 * 0.12 + 0.02 * (0.25 + 2 * 0.09), 1e-15);
  EXPECT_NEAR(p.y(), 0.4 + 0.01 * (0.25 + 2 * 0.16) + 2 * 0.02 * 0.12, 1e-15);
}

TEST(ALens, IsUndoneByItsInverse) {
  for (double x = -0.7; x <= 0.7; x += 0.1)
    for (double y = -0.5; y <= 0.5; y += 0.1) {
      const Eigen::Vector2d p(x, y);
      EXPECT_NEAR((webcam.undistorted(webcam.distorted(p)) - p).norm(), 0, 1e-9) << x << ", " << y;
    }
}

TEST(ALens, SeesNothingBeyondWhereItFoldsThePictureOver) {
  // r (1 - r^2 / 2) has its greatest value, 0.5443, at r = 0.8165
  const Distortion strong{.k1 = -0.5};
  EXPECT_TRUE(strong.undistorted({0.54, 0}).allFinite());
  EXPECT_FALSE(strong.undistorted({0.56, 0}).allFinite());
}

TEST(AMapOfALens, TellsForEachPixelWhereThePinholeSeesIt) {
  const render::Camera camera = render::Camera::of_fov(64, 48, 1.2);
  const LensMap map = LensMap::of(camera, webcam, 8192);
  ASSERT_EQ(map.positions.size(), 64u * 48u);
  EXPECT_GT(map.pinhole.width, camera.width) << "a barrel sees more";
  for (std::uint32_t row = 0; row < 48; row += 5)
    for (std::uint32_t column = 0; column < 64; column += 5) {
      const LensMap::Position& at = map.positions[row * 64 + column];
      const render::Camera& p = map.pinhole;
      const Eigen::Vector2d d =
          webcam.distorted({(double(at.column) + 0.5 - p.cx) / p.fx, (double(at.row) + 0.5 - p.cy) / p.fy});
      EXPECT_NEAR(d.x() * camera.fx + camera.cx, column + 0.5, 1e-4);
      EXPECT_NEAR(d.y() * camera.fy + camera.cy, row + 0.5, 1e-4);
      EXPECT_GE(at.column, 0);
      EXPECT_LT(at.column + 1, float(p.width));
      EXPECT_GE(at.row, 0);
      EXPECT_LT(at.row + 1, float(p.height));
    }
}

}  // namespace
}  // namespace muro::camera
