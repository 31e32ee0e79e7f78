// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <random>

#include "files_testing.hpp"
#include "muro/algorithm.hpp"
#include "muro/toolkit/rotations.hpp"
#include "store.hpp"
#include "tests/support/files.hpp"

namespace {

using namespace muro;
using namespace muro::mesh;

/// Expects a hull that is closed, convex, facing outward and around all points, with flat faces.
void expect_hull_of(const Hull& hull, const std::vector<Vec3>& points) {
  const Mesh surface = surface_of(hull);
  EXPECT_TRUE(is_closed(surface));
  EXPECT_TRUE(is_convex(surface, 2e-6));
  EXPECT_GT(volume_of(surface), 0);
  Aabb box;
  for (const Vec3& p : points) box.include({p, p});
  const double size = (box.high - box.low).norm();
  for (const Hull::Face& f : hull.faces) {
    EXPECT_NEAR(f.normal.norm(), 1, 1e-12);
    for (const Vec3& p : points) EXPECT_LT(f.normal.dot(p) - f.offset, 2e-6 * size);
    for (const std::uint32_t c : hull.corners_of(f)) EXPECT_NEAR(f.normal.dot(hull.vertices[c]), f.offset, 4e-6 * size);
  }
}

TEST(Hull, OfASheetIsAPlateOfAThousandthOfItsSize) {
  const Quat turn = from_rpy(0.3, -0.5, 1);
  std::vector<Vec3> points;
  for (const double x : {-0.3, 0.0, 0.3})
    for (const double y : {-0.2, 0.2}) points.push_back(turn * Vec3(x, y, 0) + Vec3(1, 2, 3));
  EXPECT_THROW(convex_hull(points), Error);
  Aabb box;
  for (const Vec3& p : points) box.include({p, p});
  const Hull plate = hull_or_plate(points);
  expect_hull_of(plate, points);
  const double thickness = 1e-3 * (box.high - box.low).norm();
  EXPECT_NEAR(volume_of(surface_of(plate)), 0.6 * 0.4 * thickness, 1e-6 * thickness);
}

TEST(Hull, OfPointsOnALineThereIsNone) {
  const std::vector<Vec3> points = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}};
  EXPECT_THROW(hull_or_plate(points), Error);
  EXPECT_THROW(hull_or_plate({}), Error);
}

TEST(Hull, OfABoxWithPointsInsideHasSixFacesOfFourCorners) {
  std::mt19937 engine(3);
  std::uniform_real_distribution<double> in(-1, 1);
  std::vector<Vec3> points = mesh::testing::box({-1, -2, -3}, {1, 2, 3}).vertices;
  for (int i = 0; i < 200; ++i) points.push_back({in(engine), 2 * in(engine), 3 * in(engine)});
  const Hull hull = convex_hull(points);
  expect_hull_of(hull, points);
  EXPECT_EQ(hull.vertices.size(), 8u);
  ASSERT_EQ(hull.faces.size(), 6u);
  for (const Hull::Face& f : hull.faces) EXPECT_EQ(f.count, 4u);
  EXPECT_NEAR(volume_of(surface_of(hull)), 48, 1e-9);
}

TEST(Hull, OfATurnedPrismInFloatsHasFlatEnds) {
  constexpr int sides = 32;
  const Quat turn = from_rpy(0.3, -0.7, 1.1);
  std::vector<Vec3> points;
  for (int i = 0; i < sides; ++i)
    for (const double z : {-0.1, 0.1}) {
      const Vec3 p = turn * Vec3(0.3 * std::cos(2 * M_PI * i / sides), 0.3 * std::sin(2 * M_PI * i / sides), z);
      points.push_back(p.cast<float>().cast<double>());
    }
  const Hull hull = convex_hull(points);
  expect_hull_of(hull, points);
  EXPECT_EQ(hull.faces.size(), sides + 2u);
  EXPECT_NEAR(volume_of(surface_of(hull)), 0.2 * 0.5 * sides * 0.09 * std::sin(2 * M_PI / sides), 1e-7);
}

TEST(Hull, OfRandomPointsIsClosedConvexAndAroundThem) {
  std::mt19937 engine(4);
  std::normal_distribution<double> any;
  for (const int count : {4, 5, 10, 100, 2000})
    for (const double scale : {1e-3, 1.0, 1e3}) {
      std::vector<Vec3> points;
      for (int i = 0; i < count; ++i) points.push_back(scale * Vec3(any(engine), any(engine), any(engine)));
      expect_hull_of(convex_hull(points), points);
    }
}

TEST(Hull, OfFlatPointsIsAnErrorThatNamesTheFileAndTheWayOut) {
  EXPECT_THROW(convex_hull({}), Error);
  const Vec3 same[] = {Vec3::Ones(), Vec3::Ones(), Vec3::Ones(), Vec3::Ones(), Vec3::Ones()};
  EXPECT_THROW(convex_hull(same), Error);
  const test::ScratchFolder folder;
  const std::string file = folder.file("flat.obj", "v 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\nf 1 2 3 4\n");
  Store store;
  try {
    store.hull(file, Vec3::Ones());
    FAIL();
  } catch (const Error& e) {
    EXPECT_NE(std::string(e.what()).find(file), std::string::npos) << e.what();
    EXPECT_NE(std::string(e.what()).find("meshes: exact"), std::string::npos) << e.what();
  }
}

}  // namespace
