// SPDX-License-Identifier: MIT
#include "camera_rig.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace muro::zbuffer {
namespace {

using scanner::Grid;
using scanner::RaySet;
using std::numbers::pi;

std::vector<RaySet> sets() {
  const double list[] = {0, 0, 1, 0.5, -3, -1.5, 1, 0.5, 2, 1.55, 0, -pi / 2};
  return {
      RaySet::of(Grid{.min_angle = -2.0862, .max_angle = 2.0924, .columns = 682}),
      RaySet::of(Grid{.min_angle = -pi, .max_angle = pi, .columns = 360}),
      RaySet::of(Grid{.min_angle = -0.75 * pi, .max_angle = 0.75 * pi, .columns = 1080}),
      RaySet::of(Grid{.min_angle = -0.5,
                      .max_angle = 0.5,
                      .columns = 100,
                      .min_elevation = -0.5,
                      .max_elevation = 0.5,
                      .rows = 100}),
      RaySet::of(Grid{.min_angle = 0,
                      .max_angle = 2 * pi,
                      .columns = 256,
                      .min_elevation = -0.4,
                      .max_elevation = 0.4,
                      .rows = 16}),
      RaySet::of(Grid{
          .min_angle = -1, .max_angle = 1, .columns = 7, .min_elevation = -pi / 2, .max_elevation = pi / 2, .rows = 5}),
      RaySet::of(Grid{}),
      RaySet::of(Grid{.min_angle = 1, .max_angle = 1, .min_elevation = -0.3, .max_elevation = 0.3, .rows = 20}),
      RaySet::of(std::span<const double>(list))};
}

TEST(TheCameraRigOfAScanner, HoldsEveryRayWhereThePinholeSeesIt) {
  for (const RaySet& set : sets()) {
    const CameraRig v = CameraRig::of(set, 1.5);
    ASSERT_EQ(v.samples.size(), set.size());
    for (std::uint32_t i = 0; i < set.size(); ++i) {
      const RaySample& s = v.samples[i];
      const render::Camera& c = v.cameras[s.camera];
      const Vec3 ray(1, (c.cx - s.column - 0.5) / c.fx, (c.cy - s.row - 0.5) / c.fy);
      EXPECT_NEAR((c.pose.orientation * ray.normalized() - set.directions[i]).norm(), 0, 2e-6);
      EXPECT_NEAR(s.length_per_depth, ray.norm(), 1e-5);
      for (const auto& [place, size] : {std::pair{s.column, c.width}, {s.row, c.height}}) {
        const double margin = size > 1 ? CameraRig::margin : 0;
        EXPECT_GE(place, margin - 1e-6);
        EXPECT_LE(place, size - 1 - margin + 1e-6);
      }
    }
  }
}

TEST(TheCameraRigOfAScanner, HasNoCameraWiderThanAPinholeSeesWell) {
  for (const RaySet& set : sets())
    for (const render::Camera& c : CameraRig::of(set, 1).cameras) {
      EXPECT_LE(c.width, 2 * c.fx * std::tan(0.5 * CameraRig::max_width) * 1.3 + 8);
      EXPECT_LE(c.height, 2 * c.fy * 1.9 + 8);
    }
}

TEST(TheCameraRigOfAScanner, HasAsManyCamerasAsTheWidthNeeds) {
  const auto cameras = [](double width) {
    return CameraRig::of(RaySet::of(Grid{.min_angle = -0.5 * width, .max_angle = 0.5 * width, .columns = 500}), 1)
        .cameras.size();
  };
  EXPECT_EQ(cameras(1.0), 1u);
  EXPECT_EQ(cameras(240 * pi / 180), 3u);
  EXPECT_EQ(cameras(270 * pi / 180), 3u);
  EXPECT_EQ(cameras(2 * pi), 4u);
}

TEST(TheCameraRigOfAScanner, IsOnePixelHighWhereAllRaysAreLevel) {
  for (const render::Camera& c : CameraRig::of(sets()[0], 4).cameras) EXPECT_EQ(c.height, 1u);
}

TEST(TheCameraRigOfAScanner, HasAsManyPixelsForEachRayAsRequested) {
  const RaySet set = RaySet::of(Grid{.min_angle = -0.7, .max_angle = 0.7, .columns = 141});
  for (const double pixels : {0.5, 1.0, 4.0}) {
    const CameraRig v = CameraRig::of(set, pixels);
    for (std::size_t i = 1; i < set.size(); ++i)
      EXPECT_GE(v.samples[i - 1].column - v.samples[i].column, pixels - 1e-3) << "more towards the sides";
    EXPECT_NEAR(v.samples[70].column - v.samples[71].column, pixels, 0.001 * pixels) << "in the middle";
  }
}

}  // namespace
}  // namespace muro::zbuffer
