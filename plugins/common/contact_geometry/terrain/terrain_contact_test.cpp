// SPDX-License-Identifier: MIT
// Compares contacts of shapes with heightmaps with the closed forms of a plane, ridges and peaks, and with points of
// the surface that are in a shape.
#include <gtest/gtest.h>

#include <random>

#include "muro/toolkit/rotations.hpp"
#include "terrain_contacts.hpp"

namespace muro::terrain_contact {
namespace {

constexpr double margin = 0.02;

/// A heightmap with heights given by a function.
struct Hills {
  std::vector<float> values;
  Heightmap map;
  template <class Height>
  Hills(std::uint32_t columns, std::uint32_t rows, double x, double y, Height height) {
    values.resize(std::size_t(columns) * rows);
    map = {values, columns, rows, {x, y, 1}};
    for (std::uint32_t r = 0; r < rows; ++r)
      for (std::uint32_t c = 0; c < columns; ++c) {
        const Vec3 p = map.node(c, r);
        values[r * columns + c] = float(height(p.x(), p.y()));
      }
  }
};

mesh::Hull wedge() {
  const std::vector<Vec3> points{{-0.2, -0.1, -0.1}, {0.2, -0.1, -0.1}, {0.2, 0.1, -0.1},
                                 {-0.2, 0.1, -0.1},  {0.2, -0.1, 0.1},  {0.2, 0.1, 0.1}};
  return mesh::convex_hull(points);
}

std::vector<ConvexShape> shapes(const mesh::Hull& hull) {
  return {{.kind = ShapeKind::box, .size = {0.3, 0.2, 0.1}},
          {.kind = ShapeKind::sphere, .size = {0.12, 0, 0}},
          {.kind = ShapeKind::cylinder, .size = {0.1, 0, 0.25}},
          {.kind = ShapeKind::capsule, .size = {0.06, 0, 0.2}},
          {.kind = ShapeKind::mesh, .size = {1, 1, 1}, .hull = &hull}};
}

/// Returns how far the shape reaches along `n` from its origin.
double reach(const ConvexShape& s, const Vec3& n) {
  const Vec3 d = s.pose.orientation.conjugate() * n;
  switch (s.kind) {
    case ShapeKind::box:
      return 0.5 * s.size.dot(d.cwiseAbs());
    case ShapeKind::sphere:
      return s.size.x();
    case ShapeKind::cylinder:
      return s.size.x() * d.head<2>().norm() + 0.5 * s.size.z() * std::abs(d.z());
    case ShapeKind::capsule:
      return s.size.x() + 0.5 * s.size.z() * std::abs(d.z());
    default: {
      double far = -1;
      for (const Vec3& v : s.hull->vertices) far = std::max(far, v.dot(d));
      return far;
    }
  }
}

bool is_inside(const ConvexShape& s, const Vec3& point, double by) {
  const Vec3 p = s.pose.inverse() * point;
  const double off = p.head<2>().norm(), half = 0.5 * s.size.z();
  switch (s.kind) {
    case ShapeKind::box:
      return (p.cwiseAbs().array() < 0.5 * s.size.array() - by).all();
    case ShapeKind::sphere:
      return p.norm() < s.size.x() - by;
    case ShapeKind::cylinder:
      return off < s.size.x() - by && std::abs(p.z()) < half - by;
    case ShapeKind::capsule:
      return Vec3(p.x(), p.y(), std::max(0.0, std::abs(p.z()) - half)).norm() < s.size.x() - by;
    default:
      return std::all_of(s.hull->faces.begin(), s.hull->faces.end(),
                         [&](const mesh::Hull::Face& f) { return f.normal.dot(p) < f.offset - by; });
  }
}

struct Found {
  TerrainContacts contacts;
  int count;
  Found(const Heightmap& map, const ConvexShape& shape, const Pose& at = {})
      : count(find_contacts(map, at, shape, margin, contacts)) {}
  const TerrainContact& deepest() const {
    return *std::min_element(contacts.begin(), contacts.begin() + count,
                             [](const auto& a, const auto& b) { return a.gap < b.gap; });
  }
};

Quat random_turn(std::mt19937& random) {
  std::normal_distribution<double> normal;
  const double w = normal(random), x = normal(random), y = normal(random), z = normal(random);
  return Quat(w, x, y, z).normalized();
}

TEST(TerrainContacts, WithAPlaneAreThoseOfThePlane) {
  const Hills slope(41, 31, 4, 6, [](double x, double y) { return 0.4 + 0.3 * x - 0.2 * y; });
  const Vec3 normal = Vec3(-0.3, 0.2, 1).normalized();
  const Pose at{{1, -2, 0.5}, from_rpy(0.1, -0.2, 1)};
  const mesh::Hull hull = wedge();
  std::mt19937 random(3);
  std::uniform_real_distribution<double> place(-1, 1);
  int flat = 0;
  for (ConvexShape shape : shapes(hull))
    for (int i = 0; i < 400; ++i) {
      const bool lies = i % 4 == 0;
      const Quat turn = lies ? Quat(Quat::FromTwoVectors(Vec3::UnitZ(), normal) *
                                    from_rpy(i % 8 == 0 ? 0 : M_PI / 2, 0, 3 * place(random)))
                             : random_turn(random);
      shape.pose.orientation = at.orientation * turn;
      const double x = place(random), y = place(random), gap = 0.015 * place(random) - 0.01;
      const Vec3 ground(x, y, 0.4 + 0.3 * x - 0.2 * y), up = at.orientation * normal;
      shape.pose.position = at * ground + (reach(shape, Vec3(-up)) + gap) * up;
      const Found found(slope.map, shape, at);
      ASSERT_GT(found.count, 0) << int(shape.kind) << " " << i;
      EXPECT_NEAR(found.deepest().gap, gap, 1e-6) << int(shape.kind) << " " << i;
      for (int k = 0; k < found.count; ++k) {
        const TerrainContact& c = found.contacts[std::size_t(k)];
        EXPECT_LT((c.normal - up).norm(), 1e-5) << int(shape.kind) << " " << i;
        EXPECT_NEAR(up.dot(c.position - at * ground), 0.5 * c.gap, 1e-6);
      }
      if (lies && shape.kind == ShapeKind::box) {
        ++flat;
        EXPECT_EQ(found.count, 4);
      }
    }
  EXPECT_GT(flat, 0);
}

TEST(TerrainContacts, OfABallHaveTheNearestPointsOfTheSurface) {
  std::mt19937 random(5);
  std::uniform_real_distribution<float> height(0, 0.4f);
  const Hills rough(15, 15, 1.4, 1.4, [&](double, double) { return height(random); });
  std::uniform_real_distribution<double> place(-0.5, 0.5), up(-0.02, 0.01);
  for (int i = 0; i < 300; ++i) {
    ConvexShape ball{.kind = ShapeKind::sphere, .size = {0.15, 0, 0}};
    const double x = place(random), y = place(random);
    // the lowest place where it is clear of the surface, found by points 2 mm apart, which may be wrong by 3 mm
    double low = 0;
    for (double u = -0.16; u <= 0.16; u += 0.002)
      for (double v = -0.16; v <= 0.16; v += 0.002)
        if (const double rest = 0.15 * 0.15 - u * u - v * v; rest > 0)
          low = std::max(low, rough.map.ground_at(x + u, y + v)->height + std::sqrt(rest));
    const double shift = up(random);
    ball.pose.position = {x, y, low + shift};
    const Found found(rough.map, ball);
    if (shift > 0.003) {
      for (int k = 0; k < found.count; ++k) EXPECT_GT(found.contacts[std::size_t(k)].gap, 0) << i;
    }
    if (shift < -0.001) {
      ASSERT_GT(found.count, 0) << i;
      EXPECT_LT(found.deepest().gap, 0) << i;
      EXPECT_GE(found.deepest().gap, shift - 0.003) << i;
    }
    for (int k = 0; k < found.count; ++k) {
      const TerrainContact& c = found.contacts[std::size_t(k)];
      const Vec3 on_ground = c.position - 0.5 * c.gap * c.normal;
      EXPECT_NEAR((ball.pose.position - on_ground).norm(), 0.15 + c.gap, 1e-9) << i;
      EXPECT_NEAR(rough.map.ground_at(on_ground.x(), on_ground.y())->height, on_ground.z(), 1e-4) << i;
    }
  }
}

TEST(TerrainContacts, AreThereWhereTheSurfaceIsInTheShapeAndNowhereElse) {
  std::mt19937 random(9);
  std::uniform_real_distribution<float> height(0, 0.15f);
  const Hills rough(25, 25, 2.4, 2.4, [&](double, double) { return height(random); });
  std::uniform_real_distribution<double> place(-0.8, 0.8), above(0, 0.3);
  const mesh::Hull hull = wedge();
  int overlaps = 0, apart = 0;
  for (ConvexShape shape : shapes(hull))
    for (int i = 0; i < 150; ++i) {
      const double x = place(random), y = place(random), z = above(random);
      shape.pose = {{x, y, z}, random_turn(random)};
      bool inside = false, near = false;  // points of the surface inside the shape, and near it
      for (double u = -0.3; u <= 0.3; u += 0.005)
        for (double v = -0.3; v <= 0.3; v += 0.005) {
          const Vec3 p(x + u, y + v, rough.map.ground_at(x + u, y + v)->height);
          inside = inside || is_inside(shape, p, 0.003);
          near = near || is_inside(shape, p, -0.006);
        }
      const Found found(rough.map, shape);
      const double gap = found.count > 0 ? found.deepest().gap : 1;
      overlaps += inside;
      apart += !near && gap > 0;
      if (inside) {
        EXPECT_LT(gap, 0) << int(shape.kind) << " " << i;
      }
      if (!near && z > 0.15) {
        EXPECT_GT(gap, -1e-3) << int(shape.kind) << " " << i;
      }
    }
  EXPECT_GT(overlaps, 100);
  EXPECT_GT(apart, 100);
}

TEST(TerrainContacts, OnARidgeHoldWhatLiesAcrossIt) {
  const Hills ridge(3, 3, 2, 2, [](double x, double) { return 1 - std::abs(x); });
  const double sunk = 0.005;
  ConvexShape box{
      .kind = ShapeKind::box, .size = {0.4, 0.3, 0.1}, .pose = {{0.05, 0.2, 1.05 - sunk}, Quat::Identity()}};
  const Found under_box(ridge.map, box);
  ASSERT_EQ(under_box.count, 2);
  for (int k = 0; k < 2; ++k) {
    const TerrainContact& c = under_box.contacts[std::size_t(k)];
    EXPECT_NEAR(c.gap, -sunk, 1e-9);
    EXPECT_LT((c.normal - Vec3::UnitZ()).norm(), 1e-9);
    EXPECT_NEAR(c.position.x(), 0, 1e-9);
    EXPECT_NEAR(std::abs(c.position.y() - 0.2), 0.15, 1e-9);
  }
  // a wheel that rolls over it
  ConvexShape wheel{.kind = ShapeKind::cylinder,
                    .size = {0.2, 0, 0.1},
                    .pose = {{0.05, 0, 1 + std::sqrt(0.195 * 0.195 - 0.0025)}, from_rpy(M_PI / 2, 0, 0)}};
  const Found under_wheel(ridge.map, wheel);
  ASSERT_GE(under_wheel.count, 2);
  for (int k = 0; k < under_wheel.count; ++k) {
    EXPECT_NEAR(under_wheel.contacts[std::size_t(k)].gap, -sunk, 1e-9);
    EXPECT_LT((under_wheel.contacts[std::size_t(k)].normal - (wheel.pose.position - Vec3(0, 0, 1)) / 0.195).norm(),
              1e-9);
  }
  ConvexShape capsule{
      .kind = ShapeKind::capsule, .size = {0.1, 0, 0.4}, .pose = {{0, 0, 1.1 - sunk}, from_rpy(0, M_PI / 2, 0)}};
  const Found under_capsule(ridge.map, capsule);
  ASSERT_GT(under_capsule.count, 0);
  EXPECT_NEAR(under_capsule.deepest().gap, -sunk, 1e-9);
  EXPECT_LT((under_capsule.deepest().normal - Vec3::UnitZ()).norm(), 1e-9);
}

TEST(TerrainContacts, OnAPeakHoldABoxThatNoCornerTouches) {
  const Hills peak(3, 3, 2, 2, [](double x, double y) { return x == 0 && y == 0 ? 0.5 : 0; });
  const ConvexShape box{
      .kind = ShapeKind::box, .size = {0.2, 0.2, 0.1}, .pose = {{0.02, 0.01, 0.545}, Quat::Identity()}};
  const Found found(peak.map, box);
  ASSERT_EQ(found.count, 1);
  EXPECT_NEAR(found.contacts[0].gap, -0.005, 1e-9);
  EXPECT_LT((found.contacts[0].position - Vec3(0, 0, 0.4975)).norm(), 1e-9);
}

TEST(TerrainContacts, PushUpWhatIsBelowHoweverDeep) {
  const Hills flat(5, 5, 4, 4, [](double, double) { return 2; });
  const mesh::Hull hull = wedge();
  for (ConvexShape shape : shapes(hull)) {
    shape.pose.position = {0.3, 0.2, -3};
    const Found found(flat.map, shape);
    ASSERT_GT(found.count, 0) << int(shape.kind);
    EXPECT_NEAR(found.deepest().gap, -5 - reach(shape, Vec3(0, 0, -1)), 1e-6) << int(shape.kind);
    EXPECT_EQ(found.deepest().normal, Vec3(0, 0, 1));
  }
}

TEST(TerrainContacts, AreNoneOfAShapeThatIsNowhere) {
  const Hills flat(5, 5, 4, 4, [](double, double) { return 2; });
  const mesh::Hull hull = wedge();
  for (ConvexShape shape : shapes(hull)) {
    shape.pose.position = {0.3, NAN, 2};
    EXPECT_EQ(Found(flat.map, shape).count, 0) << int(shape.kind);
    shape.pose = {{0.3, 0.2, 2}, Quat(NAN, 0, 0, 0)};
    EXPECT_EQ(Found(flat.map, shape).count, 0) << int(shape.kind);
  }
}

TEST(TerrainContacts, EndAtTheRimWhichHoldsWhatLiesOnIt) {
  const Hills flat(5, 5, 2, 2, [](double, double) { return 0; });
  const ConvexShape beyond{.kind = ShapeKind::box, .size = {0.2, 0.2, 0.2}, .pose = {{1.11, 0, 0}, Quat::Identity()}};
  EXPECT_EQ(Found(flat.map, beyond).count, 0);
  const ConvexShape over{.kind = ShapeKind::box, .size = {0.4, 0.2, 0.2}, .pose = {{0.95, 0, 0.099}, Quat::Identity()}};
  const Found found(flat.map, over);
  double farthest = 0;
  for (int k = 0; k < found.count; ++k) {
    EXPECT_NEAR(found.contacts[std::size_t(k)].gap, -0.001, 1e-9);
    EXPECT_EQ(found.contacts[std::size_t(k)].normal, Vec3(0, 0, 1));
    farthest = std::max(farthest, found.contacts[std::size_t(k)].position.x());
  }
  EXPECT_NEAR(farthest, 1, 1e-9);
  // a ball that rolls off it
  const ConvexShape ball{
      .kind = ShapeKind::sphere, .size = {0.1, 0, 0}, .pose = {{1.06, 0.1, 0.075}, Quat::Identity()}};
  const Found under_ball(flat.map, ball);
  ASSERT_GT(under_ball.count, 0);
  EXPECT_LT((under_ball.deepest().normal - Vec3(0.06, 0, 0.075).normalized()).norm(), 1e-9);
}

}  // namespace
}  // namespace muro::terrain_contact
