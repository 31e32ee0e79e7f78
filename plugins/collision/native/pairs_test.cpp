// SPDX-License-Identifier: MIT
// Depth, normal and place of the deepest point, compared with closed forms and geometry.
#include "muro/toolkit/rotations.hpp"
#include "pairs_testing.hpp"

namespace {

using namespace muro;
using namespace muro::native;
using namespace muro::native::testing;

constexpr ShapeKind convex[] = {ShapeKind::box, ShapeKind::sphere, ShapeKind::cylinder, ShapeKind::capsule};
const Quat on_side = from_rpy(M_PI / 2, 0, 0);  // z axis to -y

TransformedShape at(const Shape& s, const Vec3& p, const Quat& q = Quat::Identity()) { return transformed(s, {p, q}); }

Manifold touch(const TransformedShape& a, const TransformedShape& b) {
  Manifold m;
  collide_shapes(a, b, m);
  return m;
}

void expect_deepest(const Manifold& m, const Vec3& point, const Vec3& normal, double depth) {
  ASSERT_GT(m.count, 0);
  const ContactPoint& c = *deepest(m);
  EXPECT_NEAR(c.depth, depth, 1e-9);
  EXPECT_LT((c.normal - normal).norm(), 1e-9) << c.normal.transpose();
  EXPECT_LT((c.point - point).norm(), 1e-8) << c.point.transpose();
}

TEST(Pairs, SphereAndSphereMeetOnTheLineOfCentres) {
  expect_deepest(touch(at(Shape::sphere(1), {0, 0, 0}), at(Shape::sphere(0.5), {1.2, 0, 0})), {0.85, 0, 0}, {-1, 0, 0},
                 0.3);
  EXPECT_EQ(touch(at(Shape::sphere(1), {0, 0, 0}), at(Shape::sphere(0.5), {1.5, 0, 0})).count, 0);
}

TEST(Pairs, PlaneMeetsEachKindAtItsLowestPoint) {
  const Quat tilt = from_rpy(0.3, -0.5, 1.1);
  const Vec3 n = tilt * Vec3::UnitZ(), origin(0.4, -2, 1);
  const TransformedShape plane = at(Shape::plane(), origin, tilt);
  Randoms random(3);
  for (const ShapeKind kind : convex)
    for (int i = 0; i < 200; ++i) {
      TransformedShape s = at(random.shape(kind), random.direction(), random.rotation());
      const double depth = random.uniform(-0.2, 0.5) * s.half.minCoeff();
      s.centre += n * (n.dot(origin) + extent(s, -n) - depth);  // lowest point `depth` below
      const Manifold m = touch(s, plane), mirrored = touch(plane, s);
      ASSERT_EQ(m.count > 0, depth > 0);
      ASSERT_EQ(mirrored.count, m.count);
      if (depth <= 0) continue;
      EXPECT_NEAR(deepest(m)->depth, depth, 1e-12);
      for (int k = 0; k < m.count; ++k) {
        const ContactPoint& c = m.points[k];
        EXPECT_LT((c.normal - n).norm(), 1e-15);
        EXPECT_NEAR(n.dot(c.point - origin), -0.5 * c.depth, 1e-12);
        EXPECT_LT(outside(s, c.point - 0.5 * c.depth * n), 1e-12);
        EXPECT_EQ(mirrored.points[k].normal, -c.normal);
      }
    }
}

TEST(Pairs, SphereLeavesABoxByTheNearestFaceWhenItsCentreIsInside) {
  const TransformedShape box = at(Shape::box({2, 4, 6}), {0, 0, 0});
  expect_deepest(touch(box, at(Shape::sphere(0.5), {0.9, 0, 0})), {0.7, 0, 0}, {-1, 0, 0}, 0.6);
  expect_deepest(touch(box, at(Shape::sphere(0.5), {0, -1.8, 0})), {0, -1.65, 0}, {0, 1, 0}, 0.7);
  expect_deepest(touch(box, at(Shape::sphere(0.5), {1.3, 0, 0})), {0.9, 0, 0}, {-1, 0, 0}, 0.2);
  const Vec3 away = Vec3(1, 1, 1).normalized();
  expect_deepest(touch(at(Shape::sphere(0.5), Vec3(1, 2, 3) + 0.4 * away), box), Vec3(1, 2, 3) - 0.05 * away, away,
                 0.1);
}

TEST(Pairs, SphereMeetsACylinderAtSideEndAndRim) {
  const TransformedShape cylinder = at(Shape::cylinder(1, 2), {0, 0, 0});
  expect_deepest(touch(at(Shape::sphere(0.5), {0, 1.4, 0.3}), cylinder), {0, 0.95, 0.3}, {0, 1, 0}, 0.1);
  expect_deepest(touch(at(Shape::sphere(0.5), {0.2, 0, -1.4}), cylinder), {0.2, 0, -0.95}, {0, 0, -1}, 0.1);
  expect_deepest(touch(at(Shape::sphere(0.5), {0.7, 0, 0.1}), cylinder), {0.6, 0, 0.1}, {1, 0, 0},
                 0.8);  // centre inside
  expect_deepest(touch(at(Shape::sphere(0.5), {0.3, 0, 0.8}), cylinder), {0.3, 0, 0.65}, {0, 0, 1},
                 0.7);  // centre inside
  const Vec3 away = Vec3(1, 0, 1).normalized();
  expect_deepest(touch(at(Shape::sphere(0.5), Vec3(1, 0, 1) + 0.3 * away), cylinder), Vec3(1, 0, 1) - 0.1 * away, away,
                 0.2);
}

TEST(Pairs, CapsulesMeetWhereTheirAxesAreNearest) {
  const Shape capsule = Shape::capsule(0.5, 4);
  const TransformedShape upright = at(capsule, {0, 0, 0});
  expect_deepest(touch(at(capsule, {0.9, 0.7, 0.4}, on_side), upright), {0.45, 0, 0.4}, {1, 0, 0}, 0.1);  // crossed
  expect_deepest(touch(at(capsule, {0, 0, 4.8}), upright), {0, 0, 2.4}, {0, 0, 1}, 0.2);                  // end to end
  expect_deepest(touch(at(Shape::sphere(0.5), {0.6, 0, 1}), upright), {0.3, 0, 1}, {1, 0, 0}, 0.4);
  const Manifold crossed = touch(at(capsule, {0, 0, 0}, on_side), upright);  // axes meet: both ways out are right
  expect_deepest(crossed, {0, 0, 0}, {crossed.points[0].normal.x() > 0 ? 1.0 : -1.0, 0, 0}, 1);
}

TEST(Pairs, BoxEdgesThatCrossGiveTheirCommonPerpendicular) {
  // Both boxes stand on an edge: the ridge of one runs along x, the lowest edge of the other along y.
  const double ridge = std::sqrt(2.0) / 2;
  const TransformedShape lower = at(Shape::box({4, 1, 1}), {0, 0, 0}, from_rpy(M_PI / 4, 0, 0));
  const TransformedShape upper = at(Shape::box({1, 4, 1}), {0.2, -0.3, 2 * ridge - 0.05}, from_rpy(0, M_PI / 4, 0));
  const Manifold m = touch(upper, lower);
  EXPECT_EQ(m.count, 1);
  expect_deepest(m, {0.2, 0, ridge - 0.025}, {0, 0, 1}, 0.05);
}

TEST(Pairs, BoxCornerOnAFaceIsOnePoint) {
  const Quat on_corner(turn_between(Vec3(1, 1, 1).normalized(), -Vec3::UnitZ()));
  const double tall = std::sqrt(3.0) / 2;
  const Manifold m =
      touch(at(Shape::box({1, 1, 1}), {0.1, 0.2, 0.5 + tall - 0.02}, on_corner), at(Shape::box({4, 4, 1}), {0, 0, 0}));
  EXPECT_EQ(m.count, 1);
  expect_deepest(m, {0.1, 0.2, 0.49}, {0, 0, 1}, 0.02);
}

TEST(Pairs, CrossedCylindersMeetBetweenTheirAxes) {
  const TransformedShape upright = at(Shape::cylinder(0.5, 4), {0, 0, 0});
  const Manifold m = touch(at(Shape::cylinder(0.3, 4), {0.7, 0.4, 0.3}, on_side), upright);
  EXPECT_EQ(m.count, 1);
  expect_deepest(m, {0.45, 0, 0.3}, {1, 0, 0}, 0.1);
}

TEST(Pairs, CylinderSideMeetsABoxEdgeAlongTheRadius) {
  // Seen along y: a circle of 0.5 above the corner (1, 1) of a square.
  const Vec3 away = Vec3(1, 0, 2).normalized();
  const TransformedShape box = at(Shape::box({2, 2, 2}), {0, 0, 0});
  const Manifold m = touch(at(Shape::cylinder(0.5, 1), Vec3(1, 0, 1) + 0.4 * away, on_side), box);
  EXPECT_EQ(m.count, 2);
  ASSERT_GT(m.count, 0);
  for (int i = 0; i < m.count; ++i) {
    EXPECT_NEAR(m.points[i].depth, 0.1, 1e-9);
    EXPECT_LT((m.points[i].normal - away).norm(), 1e-7);
    EXPECT_NEAR(std::abs(m.points[i].point.y()), 0.5, 1e-9);
  }
}

TEST(Pairs, EqualCentresStillGiveTheLeastDepth) {
  Randoms random(5);
  for (const ShapeKind a : convex)
    for (const ShapeKind b : convex)
      for (int i = 0; i < 20; ++i) {
        const bool parallel = i < 10;
        const TransformedShape first =
            at(random.shape(a), {1, 2, 3}, parallel ? random.right_angles() : random.rotation());
        const TransformedShape second =
            at(random.shape(b), {1, 2, 3}, parallel ? random.right_angles() : random.rotation());
        const Manifold m = touch(first, second);
        ASSERT_GT(m.count, 0);
        const ContactPoint& c = *deepest(m);
        EXPECT_NEAR(depth_along(first, second, c.normal), c.depth, 1e-9);
        EXPECT_LE(c.depth, sampled_depth(first, second) + 1e-9);
      }
}

TEST(Pairs, NearlyParallelAxesStillGiveTheLeastDepth) {
  Randoms random(6);
  for (const ShapeKind a : convex)
    for (const ShapeKind b : convex)
      for (int i = 0; i < 40; ++i) {
        const Quat turn = random.rotation();
        const Quat nearly = turn * rotation_of(Vec3(random.direction() * std::pow(10.0, -random.uniform(1, 16))));
        const TransformedShape first = at(random.shape(a), {0, 0, 0}, turn);
        const TransformedShape second = at(random.shape(b), 0.3 * random.length() * random.direction(), nearly);
        const Manifold m = touch(first, second);
        if (m.count == 0) continue;
        const ContactPoint& c = *deepest(m);
        const double size = size_of(first) + size_of(second);
        EXPECT_NEAR(depth_along(first, second, c.normal), c.depth, 1e-6 * size);
        EXPECT_LE(c.depth, sampled_depth(first, second) + 1e-6 * size);
      }
}

TEST(Pairs, ExchangedArgumentsGiveTheMirroredResult) {
  Randoms random(8);
  int touching = 0;
  for (const ShapeKind a : convex)
    for (const ShapeKind b : convex)
      for (int i = 0; i < 100; ++i) {
        const TransformedShape first = at(random.shape(a), {0, 0, 0}, random.rotation());
        const TransformedShape second = at(random.shape(b), random.length() * random.direction(), random.rotation());
        const Manifold m = touch(first, second), mirrored = touch(second, first);
        ASSERT_EQ(mirrored.count > 0, m.count > 0);
        if (m.count == 0) continue;
        ++touching;
        EXPECT_NEAR(deepest(mirrored)->depth, deepest(m)->depth, 1e-9);
        EXPECT_LT((deepest(mirrored)->normal + deepest(m)->normal).norm(), 1e-6);
      }
  EXPECT_GT(touching, 400);
}

TEST(Pairs, TinyAndHugeShapesScale) {
  Randoms random(9);
  for (const ShapeKind a : convex)
    for (const ShapeKind b : convex)
      for (int i = 0; i < 40; ++i) {
        const TransformedShape first = at(random.shape(a), {0, 0, 0}, random.rotation());
        const TransformedShape second = at(random.shape(b), random.length() * random.direction(), random.rotation());
        const Manifold m = touch(first, second);
        for (const double scale : {1e-4, 1e4}) {
          TransformedShape p = first, q = second;
          p.half *= scale, q.half *= scale, q.centre *= scale;
          const Manifold scaled = touch(p, q);
          ASSERT_EQ(scaled.count > 0, m.count > 0);
          if (m.count > 0) {
            EXPECT_NEAR(deepest(scaled)->depth / scale, deepest(m)->depth, 1e-9);
          }
        }
      }
}

TEST(Pairs, SmallOnHugeAgreesWithAPlane) {
  Randoms random(10);
  const TransformedShape ground = at(Shape::box({1e4, 1e4, 1e3}), {0, 0, -500}), plane = at(Shape::plane(), {0, 0, 0});
  for (const ShapeKind kind : convex)
    for (int i = 0; i < 100; ++i) {
      TransformedShape s =
          at(random.shape(kind), {100 * random.uniform(-1, 1), 100 * random.uniform(-1, 1), 0}, random.rotation());
      s.half *= 1e-2;
      s.centre.z() = extent(s, -Vec3::UnitZ()) - 0.05 * s.half.minCoeff();
      const Manifold m = touch(s, ground), reference = touch(s, plane);
      ASSERT_GT(m.count, 0);
      EXPECT_NEAR(deepest(m)->depth, deepest(reference)->depth, 1e-9);
      EXPECT_LT((deepest(m)->normal - Vec3::UnitZ()).norm(), 1e-9);
      EXPECT_LT((deepest(m)->point - deepest(reference)->point).norm(), 1e-6);
    }
}

TEST(Pairs, EveryPointLiesHalfWayBetweenTwoPointsOfTheShapes) {
  Randoms random(11);
  for (const ShapeKind a : convex)
    for (const ShapeKind b : convex)
      for (int i = 0; i < 150; ++i) {
        const bool parallel = i % 3 == 0;
        const TransformedShape first =
            at(random.shape(a), {0, 0, 0}, parallel ? random.right_angles() : random.rotation());
        const TransformedShape second = at(random.shape(b), random.length() * random.direction(),
                                           parallel ? random.right_angles() : random.rotation());
        const Manifold m = touch(first, second);
        const double size = size_of(first) + size_of(second);
        for (int k = 0; k < m.count; ++k) {
          const ContactPoint& c = m.points[k];
          EXPECT_GT(c.depth, 0);
          EXPECT_NEAR(c.normal.norm(), 1, 1e-12);
          EXPECT_LT(outside(first, c.point - 0.5 * c.depth * c.normal), 1e-6 * size) << int(a) << int(b) << " " << i;
          EXPECT_LT(outside(second, c.point + 0.5 * c.depth * c.normal), 1e-6 * size) << int(a) << int(b) << " " << i;
        }
      }
}

TEST(Pairs, PlanesAndMeshesTouchNothing) {
  const TransformedShape plane = at(Shape::plane(), {0, 0, 0});
  EXPECT_EQ(touch(plane, at(Shape::plane(), {0, 0, -1})).count, 0);
  EXPECT_EQ(touch(at({.kind = ShapeKind::mesh, .size = {1, 1, 1}}, {0, 0, -1}), plane).count, 0);
}

}  // namespace
