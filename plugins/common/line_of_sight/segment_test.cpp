// SPDX-License-Identifier: MIT
#include "segment.hpp"

#include <gtest/gtest.h>

#include <random>

namespace muro::line_of_sight {
namespace {

bool cuts(const Shape& shape, const Vec3& a, const Vec3& b) { return passes_through(Segment::between(a, b), shape); }

bool is_in(const Shape& s, const Vec3& p) {
  const double r = s.size.x(), half = 0.5 * s.size.z();
  const double over = std::max(std::abs(p.z()) - half, 0.0);
  switch (s.kind) {
    case ShapeKind::box:
      return (p.array().abs() < 0.5 * s.size.array()).all();
    case ShapeKind::sphere:
      return p.norm() < r;
    case ShapeKind::cylinder:
      return p.head<2>().norm() < r && std::abs(p.z()) < half;
    default:
      return Vec3(p.x(), p.y(), over).norm() < r;
  }
}

TEST(LineOfSight, AgreesWithPointsAlongTheLine) {
  std::mt19937 engine(5);
  std::uniform_real_distribution<double> at(-2, 2);
  const Shape shapes[] = {Shape::box({1, 0.6, 1.4}), Shape::sphere(0.7), Shape::cylinder(0.5, 1.2),
                          Shape::capsule(0.4, 0.9)};
  int cut = 0, between_points = 0;
  for (const Shape& s : shapes)
    for (int k = 0; k < 2000; ++k) {
      const Vec3 a(at(engine), at(engine), at(engine)), b(at(engine), at(engine), at(engine));
      if (is_in(s, a) || is_in(s, b)) {
        EXPECT_FALSE(cuts(s, a, b)) << "it holds an end";
        continue;
      }
      int inside = 0;
      for (int i = 1; i < 400; ++i) inside += is_in(s, a + i / 400.0 * (b - a));
      if (inside > 0) {
        EXPECT_TRUE(cuts(s, a, b)) << int(s.kind) << " " << k;
      } else {
        between_points += cuts(s, a, b);
      }
      cut += inside > 0;
    }
  EXPECT_GT(cut, 500);
  EXPECT_LT(between_points, cut / 50) << "short cuts of corners";
}

TEST(LineOfSight, IsNotCutByWhatItOnlyTouches) {
  const Shape box = Shape::box({2, 2, 2});
  EXPECT_FALSE(cuts(box, {-3, 0, 1}, {3, 0, 1})) << "along a face";
  EXPECT_FALSE(cuts(box, {-3, 1, 1}, {3, 1, 1})) << "along an edge";
  EXPECT_FALSE(cuts(box, {1, 0, 0}, {3, 0, 0})) << "from a face";
  EXPECT_TRUE(cuts(box, {-3, 0, 0.999}, {3, 0, 0.999}));
  EXPECT_FALSE(cuts(box, {0, 0, 0}, {3, 0, 0})) << "from inside";
  EXPECT_FALSE(cuts(box, {2, 0, 0}, {3, 0, 0})) << "beside";
  EXPECT_FALSE(cuts(Shape::sphere(1), {-3, 1, 0}, {3, 1, 0})) << "a tangent";
  EXPECT_TRUE(cuts(Shape::cylinder(1, 2), {0, 0.5, -3}, {0, 0.5, 3})) << "along the axis";
  EXPECT_FALSE(cuts(Shape::plane(), {0, 0, -1}, {3, 0, -1}));
}

/// A ridge along y: heights 0, 0, 1, 0, 0 at x = -2 .. 2.
struct Ridge {
  std::vector<float> values;
  Heightmap map;
  Ridge() {
    for (int row = 0; row < 5; ++row)
      for (int column = 0; column < 5; ++column) values.push_back(column == 2 ? 1.0f : 0.0f);
    map = {values, 5, 5, {4, 4, 1}};
  }
  bool cuts(const Vec3& a, const Vec3& b) const { return passes_under(Segment::between(a, b), map, 1); }
};

TEST(LineOfSight, IsCutByAHillAndNotOverItsTop) {
  const Ridge ridge;
  EXPECT_TRUE(ridge.cuts({-1.5, 0.3, 0.2}, {1.5, -0.4, 0.2}));
  EXPECT_TRUE(ridge.cuts({-1.5, 0.3, 0.98}, {1.5, -0.4, 0.98}));
  EXPECT_FALSE(ridge.cuts({-1.5, 0.3, 1.02}, {1.5, -0.4, 1.02}));
  EXPECT_FALSE(ridge.cuts({-1.5, -1.2, 0}, {-1.2, 1.7, 0})) << "along the foot, on flat ground";
  EXPECT_FALSE(ridge.cuts({-1.5, -1.2, -0.01}, {-1.2, 1.7, -0.01})) << "ends under the ground lie on it";
  EXPECT_TRUE(ridge.cuts({-9, 0, 0.5}, {9, 0, 0.5})) << "from beside the map";
  EXPECT_FALSE(ridge.cuts({-9, 3, 0.5}, {9, 3, 0.5})) << "all beside the map";
  EXPECT_TRUE(ridge.cuts({-9, 0, -0.5}, {-3, 0, -0.5}) == false && ridge.cuts({-3, 0, -0.5}, {9, 0, -0.5}))
      << "through the wall under the rim";
}

TEST(LineOfSight, CrossesTrianglesFromBothSides) {
  const Vec3 a(0, 0, 0), b(1, 0, 0), c(0, 1, 0);
  EXPECT_TRUE(crosses(Segment::between({0.2, 0.2, 1}, {0.2, 0.3, -1}), a, b, c));
  EXPECT_TRUE(crosses(Segment::between({0.2, 0.3, -1}, {0.2, 0.2, 1}), a, b, c));
  EXPECT_FALSE(crosses(Segment::between({0.7, 0.7, 1}, {0.7, 0.7, -1}), a, b, c));
  EXPECT_FALSE(crosses(Segment::between({0.2, 0.2, 2}, {0.2, 0.2, 1}), a, b, c));
}

TEST(LineOfSight, TouchesBoxesAlongTheWay) {
  const Aabb box{{0, 0, 0}, {1, 1, 1}};
  EXPECT_TRUE(Segment::between({-1, 0.5, 0.5}, {2, 0.5, 0.5}).touches(box));
  EXPECT_TRUE(Segment::between({0.5, 0.5, 0.5}, {0.5, 0.5, 0.5}).touches(box));
  EXPECT_FALSE(Segment::between({-1, 0.5, 0.5}, {-0.1, 0.5, 0.5}).touches(box));
  EXPECT_FALSE(Segment::between({-1, 1.5, 0.5}, {2, 1.5, 0.5}).touches(box));
}

}  // namespace
}  // namespace muro::line_of_sight
