// SPDX-License-Identifier: MIT
#include "ray_pattern.hpp"

#include <gtest/gtest.h>

#include <numbers>
#include <set>

namespace muro::raycast {
namespace {

using std::numbers::pi;

std::vector<Grid> grids() {
  return {
      {.min_angle = -2.0862, .max_angle = 2.0924, .columns = 682},
      {.min_angle = -pi, .max_angle = pi, .columns = 360},
      {.min_angle = -2, .max_angle = 2, .columns = 100, .min_elevation = -0.26, .max_elevation = 0.26, .rows = 10},
      {.min_angle = 0, .max_angle = 2 * pi, .columns = 1024, .min_elevation = -0.4, .max_elevation = 0.4, .rows = 64},
      {.min_angle = -2, .max_angle = 2, .columns = 10},
      {.min_angle = -1, .max_angle = 1, .columns = 7, .min_elevation = -pi / 2, .max_elevation = pi / 2, .rows = 5},
      {.min_angle = 0.3, .max_angle = 0.3, .columns = 1, .min_elevation = 0.2, .max_elevation = 0.2},
      {.min_angle = -2, .max_angle = 2, .columns = 40, .min_elevation = 0.7, .max_elevation = 0.7}};
}

TEST(ScanPattern, HoldsEveryRayExactlyOnce) {
  for (const Grid& grid : grids()) {
    const RayPattern pattern(grid);
    std::multiset<std::uint32_t> numbers;
    std::uint32_t packets = 0;
    for (const Sector& s : pattern.sectors()) {
      EXPECT_EQ(s.first, packets);
      packets += s.count;
    }
    EXPECT_EQ(packets, pattern.packets().size());
    for (const RayPacket& b : pattern.packets()) numbers.insert(b.ray, b.ray + b.count);
    ASSERT_EQ(numbers.size(), grid.rows * grid.columns);
    std::uint32_t next = 0;
    for (const std::uint32_t n : numbers) EXPECT_EQ(n, next++);
  }
}

/// Returns the distance of a direction (unit) to the nearest plane from the inside; negative outside.
double inside(const Frustum& f, const Vec3& d) {
  double min = 1;
  for (int k = 0; k < 4; ++k) min = std::min(min, f.x[k] * d.x() + f.y[k] * d.y() + f.z[k] * d.z());
  return min;
}

TEST(ScanPattern, BoundsEveryRayByItsFrustumAndSlopes) {
  for (const Grid& grid : grids()) {
    const RayPattern pattern(grid);
    for (const Sector& sector : pattern.sectors())
      for (const RayPacket& b : pattern.packets().subspan(sector.first, sector.count))
        for (int i = 0; i < RayPacket::size; ++i) {
          const Vec3 d(b.x[i], b.y[i], b.z[i]);
          EXPECT_GE(inside(b.frustum, d), -1e-7) << "planes are floats";
          EXPECT_GE(inside(sector.frustum, d), -1e-7);
          const double slope = d.z() / std::hypot(d.x(), d.y());
          EXPECT_GE(slope, pattern.min_slope() - 1e-12);
          EXPECT_LE(slope, pattern.max_slope() + 1e-12);
        }
  }
}

TEST(ScanPattern, CullsDirectionsBesideTheRays) {
  for (const std::size_t dense : {0, 3}) {
    const RayPattern pattern(grids()[dense]);
    for (const RayPacket& b : pattern.packets()) {
      const Vec3 first(b.x[0], b.y[0], b.z[0]);
      for (const Vec3& aside : {Vec3(0, 0, 0.1), Vec3(0, 0, -0.1), Vec3(0.11 * first.cross(Vec3::UnitZ())),
                                Vec3(-0.11 * first.cross(Vec3::UnitZ()))})
        EXPECT_LT(inside(b.frustum, (first + aside).normalized()), -0.01);
    }
  }
}

TEST(ScanPattern, CullsNothingWhereRaysGoInAllDirections) {
  const RayPattern round(Grid{.min_angle = -pi, .max_angle = pi, .columns = 12});
  for (const Vec3& d : {Vec3(1, 0, 0), Vec3(-1, 0, 0), Vec3(0, 0, 1)})
    EXPECT_EQ(inside(round.packets()[0].frustum, d), 0);
}

TEST(ScanPattern, MarksPacketsWhoseQuadsAreContiguous) {
  for (const Grid& grid : grids()) {
    const RayPattern pattern(grid);
    for (const RayPacket& b : pattern.packets()) {
      bool contiguous = b.count == RayPacket::size;
      for (std::uint32_t i = 0; i + 1 < b.count; ++i)
        if (i % 4 != 3 && b.ray[i + 1] != b.ray[i] + 1) contiguous = false;
      EXPECT_EQ(b.quads_are_contiguous, contiguous);
    }
  }
}

}  // namespace
}  // namespace muro::raycast
