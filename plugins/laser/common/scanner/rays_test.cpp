// SPDX-License-Identifier: MIT
#include "rays.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace muro::scanner {
namespace {

using std::numbers::pi;

TEST(RaysOfAScanner, GoesFromTheFirstAngleToTheLastInEqualSteps) {
  const Grid grid{.min_angle = -2.0862, .max_angle = 2.0924, .columns = 682};
  const std::vector<Vec3> rays = RaySet::of(grid).directions;
  ASSERT_EQ(rays.size(), 682u);
  EXPECT_NEAR(grid.angle_increment(), 4.1786 / 681, 1e-15);
  for (std::size_t i = 0; i < rays.size(); ++i) {
    EXPECT_NEAR(std::atan2(rays[i].y(), rays[i].x()), -2.0862 + double(i) * 4.1786 / 681, 1e-12);
    EXPECT_EQ(rays[i].z(), 0);
  }
  EXPECT_EQ(rays.front(), direction_of(-2.0862, 0));
  EXPECT_EQ(rays.back(), direction_of(2.0924, 0));
}

TEST(RaysOfAScanner, DoesNotRepeatTheRayAtTheSeamOfAFullCircle) {
  const Grid grid{.min_angle = -pi, .max_angle = pi, .columns = 8};
  EXPECT_TRUE(grid.full_circle());
  EXPECT_NEAR(grid.angle_increment(), pi / 4, 1e-15);
  const std::vector<Vec3> rays = RaySet::of(grid).directions;
  for (std::size_t i = 0; i < 8; ++i) EXPECT_NEAR((rays[i] - rays[(i + 1) % 8]).norm(), 2 * std::sin(pi / 8), 1e-12);

  const Grid open{.min_angle = -pi, .max_angle = pi - 1e-6, .columns = 8};
  EXPECT_FALSE(open.full_circle());
  EXPECT_NEAR(open.angle_increment(), (2 * pi - 1e-6) / 7, 1e-15);
}

TEST(RaysOfAScanner, NumbersRaysRowByRowFromBelow) {
  const Grid grid{
      .min_angle = -1, .max_angle = 1, .columns = 21, .min_elevation = -0.3, .max_elevation = 0.5, .rows = 6};
  const std::vector<Vec3> rays = RaySet::of(grid).directions;
  ASSERT_EQ(rays.size(), 126u);
  for (std::uint32_t row = 0; row < 6; ++row)
    for (std::uint32_t column = 0; column < 21; ++column) {
      const Vec3& d = rays[row * 21 + column];
      EXPECT_NEAR(std::asin(d.z()), -0.3 + row * 0.8 / 5, 1e-12);
      EXPECT_NEAR(std::atan2(d.y(), d.x()), -1 + column * 0.1, 1e-12);
    }
}

TEST(RaysOfAScanner, LooksAlongTheMiddleWithOneRay) {
  const Grid grid{.min_angle = -1, .max_angle = 2, .columns = 1, .min_elevation = 0.2, .max_elevation = 0.4};
  EXPECT_NEAR((RaySet::of(grid).directions[0] - direction_of(0.5, 0.3)).norm(), 0, 1e-12);
  EXPECT_EQ(grid.first_angle(), 0.5);
  EXPECT_EQ(grid.angle_increment(), 0);
}

TEST(RaysOfAScanner, TakesAListAsItIs) {
  const double list[] = {0, 0, 1, 0.5, -3, -1.5, 1, 0.5};
  const std::vector<Vec3> rays = RaySet::of(list).directions;
  ASSERT_EQ(rays.size(), 4u);
  for (std::size_t i = 0; i < 4; ++i) EXPECT_EQ(rays[i], direction_of(list[2 * i], list[2 * i + 1]));
}

TEST(RaysOfAScanner, KnowHowFarTheyAreApart) {
  const Grid grid{
      .min_angle = -1, .max_angle = 1, .columns = 21, .min_elevation = -0.3, .max_elevation = 0.5, .rows = 6};
  EXPECT_NEAR(RaySet::of(grid).spacing, 0.1, 1e-12);
  EXPECT_EQ(RaySet::of(Grid{}).spacing, 0);
  const double list[] = {0, 0, 0.1, 0, 0.2, 0, 0.2, 0, 2, 0};
  EXPECT_NEAR(RaySet::of(list).spacing, 0.1, 1e-12);
}

}  // namespace
}  // namespace muro::scanner
