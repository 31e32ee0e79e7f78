// SPDX-License-Identifier: MIT
#include "spatial_hash.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

namespace muro {
namespace {

std::vector<std::uint32_t> found_by(const SpatialHash& hash, const Vec3& centre, double radius) {
  std::vector<std::uint32_t> numbers;
  hash.each_within(centre, radius, [&](std::uint32_t i, double) { numbers.push_back(i); });
  return numbers;
}

TEST(SpatialHash, FindsWhatComparingAllWithAllFinds) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> place(-40, 40);
  std::vector<Vec3> points(500);
  for (Vec3& p : points) p = {place(engine), place(engine), 0.1 * place(engine)};
  SpatialHash hash;
  for (const double cell : {0.7, 5.0, 200.0}) {
    hash.build(points, cell);
    for (const double radius : {0.0, 3.0, 5.0, 21.0, 500.0})
      for (std::size_t k = 0; k < points.size(); k += 7) {
        std::vector<std::uint32_t> expected, found = found_by(hash, points[k], radius);
        for (std::uint32_t i = 0; i < points.size(); ++i)
          if ((points[i] - points[k]).squaredNorm() <= radius * radius) expected.push_back(i);
        std::sort(found.begin(), found.end());
        ASSERT_EQ(found, expected) << "cell " << cell << " radius " << radius;
      }
  }
}

TEST(SpatialHash, TakesPointsFarAwayAndLeavesOutWhatIsNoNumber) {
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Vec3> points = {{1e300, 0, 0}, {nan, 0, 0}, {0, 0, 0}, {1e12, -1e12, 0}, {0, 0, nan}, {0.5, 0, 0}};
  SpatialHash hash;
  hash.build(points, 1);
  EXPECT_EQ(found_by(hash, {0, 0, 0}, 1), (std::vector<std::uint32_t>{2, 5}));
  EXPECT_EQ(found_by(hash, {1e12, -1e12, 0}, 1), (std::vector<std::uint32_t>{3}));
  EXPECT_TRUE(found_by(hash, {nan, 0, 0}, 1).empty());
}

TEST(SpatialHash, IsEmptyOverNoPoints) {
  SpatialHash hash;
  EXPECT_TRUE(found_by(hash, Vec3::Zero(), 10).empty());
  hash.build({}, 1);
  EXPECT_TRUE(found_by(hash, Vec3::Zero(), 10).empty());
}

}  // namespace
}  // namespace muro
