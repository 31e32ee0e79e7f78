// SPDX-License-Identifier: MIT
// Number and places of the points of a resting contact.
#include <algorithm>

#include "muro/toolkit/rotations.hpp"
#include "pairs_testing.hpp"

namespace {

using namespace muro;
using namespace muro::native;
using namespace muro::native::testing;

TransformedShape at(const Shape& s, const Vec3& p, const Quat& q = Quat::Identity()) { return transformed(s, {p, q}); }

/// Expects every wanted point once, with this depth, and no other point.
void expect_points(const TransformedShape& a, const TransformedShape& b, double depth, const Vec3& normal,
                   const std::vector<Vec3>& wanted) {
  Manifold m;
  collide_shapes(a, b, m);
  ASSERT_EQ(m.count, int(wanted.size()));
  for (const Vec3& p : wanted) {
    int found = 0;
    for (int i = 0; i < m.count; ++i) found += (m.points[i].point - p).norm() < 1e-7;
    EXPECT_EQ(found, 1) << p.transpose();
  }
  for (int i = 0; i < m.count; ++i) {
    EXPECT_NEAR(m.points[i].depth, depth, 1e-8);
    EXPECT_LT((m.points[i].normal - normal).norm(), 1e-9);
  }
}

const TransformedShape ground = at(Shape::plane(), {0, 0, 0});
const TransformedShape slab = at(Shape::box({10, 10, 1}), {0, 0, -0.5});
const Quat on_side = from_rpy(M_PI / 2, 0, 0);
const double deep = 0.01, mid = -0.005;

TEST(Manifold, BoxOnPlaneOrBoxRestsOnItsFourCorners) {
  const TransformedShape box = at(Shape::box({2, 1, 1}), {0.3, 0.2, 0.5 - deep});
  const std::vector<Vec3> corners{{1.3, 0.7, mid}, {1.3, -0.3, mid}, {-0.7, 0.7, mid}, {-0.7, -0.3, mid}};
  expect_points(box, ground, deep, Vec3::UnitZ(), corners);
  expect_points(box, slab, deep, Vec3::UnitZ(), corners);
  expect_points(slab, box, deep, -Vec3::UnitZ(), corners);
}

TEST(Manifold, BoxThatOverhangsRestsOnTheRestOfItsFace) {
  expect_points(at(Shape::box({2, 1, 1}), {5, 0, 0.5 - deep}), slab, deep, Vec3::UnitZ(),
                {{4, 0.5, mid}, {4, -0.5, mid}, {5, 0.5, mid}, {5, -0.5, mid}});
}

TEST(Manifold, BoxTurnedOnABoxRestsOnAnOctagon) {
  const double a = 0.5 * (std::sqrt(2.0) - 1);  // where two unit squares at 45 degrees cut each other's sides
  expect_points(at(Shape::box({1, 1, 1}), {0, 0, 1 - deep}, from_rpy(0, 0, M_PI / 4)),
                at(Shape::box({1, 1, 1}), {0, 0, 0}), deep, Vec3::UnitZ(),
                {{a, 0.5, 0.5 + mid},
                 {-a, 0.5, 0.5 + mid},
                 {a, -0.5, 0.5 + mid},
                 {-a, -0.5, 0.5 + mid},
                 {0.5, a, 0.5 + mid},
                 {-0.5, a, 0.5 + mid},
                 {0.5, -a, 0.5 + mid},
                 {-0.5, -a, 0.5 + mid}});
}

TEST(Manifold, BoxOnItsEdgeRestsOnTwoPoints) {
  const TransformedShape box = at(Shape::box({2, 1, 1}), {0, 0, std::sqrt(0.5) - deep}, from_rpy(M_PI / 4, 0, 0));
  expect_points(box, ground, deep, Vec3::UnitZ(), {{1, 0, mid}, {-1, 0, mid}});
  expect_points(box, slab, deep, Vec3::UnitZ(), {{1, 0, mid}, {-1, 0, mid}});
}

TEST(Manifold, WheelRestsOnTheEndsOfItsLowestLineHoweverFarItHasTurned) {
  for (const double angle : {0.0, 0.3, 1.9, -2.5}) {
    const TransformedShape wheel =
        at(Shape::cylinder(0.3, 0.1), {1, 2, 0.3 - deep}, on_side * rotation_of({0, 0, angle}));
    expect_points(wheel, ground, deep, Vec3::UnitZ(), {{1, 1.95, mid}, {1, 2.05, mid}});
    expect_points(wheel, slab, deep, Vec3::UnitZ(), {{1, 1.95, mid}, {1, 2.05, mid}});
  }
}

TEST(Manifold, AWheelTouchesAWallAlongALineOrOnFourPoints) {
  const TransformedShape wall = at(Shape::box({1, 8, 2}), {2.5, 0, 0.8});
  const Quat turned = on_side * rotation_of({0, 0, 0.7});
  expect_points(at(Shape::cylinder(0.3, 0.1), {1.7 + deep, 0, 0.3}, turned), wall, deep, -Vec3::UnitX(),
                {{2 - mid, 0.05, 0.3}, {2 - mid, -0.05, 0.3}});
  Manifold m;  // the flat side against the wall
  collide_shapes(at(Shape::cylinder(0.3, 0.1), {1.95 + deep, 0, 0.3}, from_rpy(0, M_PI / 2, 0)), wall, m);
  ASSERT_EQ(m.count, 4);
  for (int i = 0; i < 4; ++i) {
    EXPECT_NEAR((m.points[i].point - Vec3(2 - mid, 0, 0.3)).norm(), 0.3, 1e-8);
    EXPECT_NEAR(m.points[i].depth, deep, 1e-8);
  }
}

TEST(Manifold, UprightCylinderRestsOnFourPointsOfItsRim) {
  const std::vector<Vec3> rim{{0.4, 0, mid}, {-0.4, 0, mid}, {0, 0.4, mid}, {0, -0.4, mid}};
  const TransformedShape cylinder = at(Shape::cylinder(0.4, 1), {0, 0, 0.5 - deep});
  expect_points(cylinder, ground, deep, Vec3::UnitZ(), rim);
  expect_points(cylinder, slab, deep, Vec3::UnitZ(), rim);
  expect_points(cylinder, at(Shape::cylinder(2, 1), {0, 0, -0.5}), deep, Vec3::UnitZ(), rim);
}

TEST(Manifold, LyingCapsuleRestsOnBothEnds) {
  const TransformedShape capsule = at(Shape::capsule(0.2, 1), {0, 0, 0.2 - deep}, on_side);
  expect_points(capsule, ground, deep, Vec3::UnitZ(), {{0, 0.5, mid}, {0, -0.5, mid}});
  expect_points(capsule, slab, deep, Vec3::UnitZ(), {{0, 0.5, mid}, {0, -0.5, mid}});
  // Side by side with a capsule that is shifted along: the contact is the segment that both share.
  expect_points(at(Shape::capsule(0.2, 1), {0, 0, 0}, on_side),
                at(Shape::capsule(0.3, 1), {0.5 - deep, 0.4, 0}, on_side), deep, -Vec3::UnitX(),
                {{0.2 + mid, 0.5, 0}, {0.2 + mid, -0.1, 0}});
  expect_points(at(Shape::cylinder(0.2, 1), {0, 0, 0}, on_side),
                at(Shape::cylinder(0.3, 1), {0.5 - deep, 0.4, 0}, on_side), deep, -Vec3::UnitX(),
                {{0.2 + mid, 0.5, 0}, {0.2 + mid, -0.1, 0}});
}

TEST(Manifold, FourPointsOfATiltedRimPushAndTurnLikeTheWholeRim) {
  // The sums of depths and of their moments over equally spaced points do not depend on where the points are.
  const double tilt = 1e-3, r = 0.4;
  for (const double yaw : {0.0, 0.2, 0.77}) {
    const TransformedShape cylinder = at(Shape::cylinder(r, 1), {0, 0, 0.5 - deep},
                                         Quat(from_rpy(0, 0, yaw) * from_rpy(0, tilt, 0) * from_rpy(0, 0, -1.3 * yaw)));
    Manifold m;
    collide_shapes(cylinder, ground, m);
    ASSERT_EQ(m.count, 4);
    double sum = 0;
    Vec3 moment = Vec3::Zero();
    const Vec3 downhill = from_rpy(0, 0, yaw) * Vec3::UnitX();
    for (int i = 0; i < 4; ++i) {
      sum += m.points[i].depth;
      moment += m.points[i].depth * m.points[i].point;
    }
    EXPECT_NEAR(sum, 4 * deep, 1e-5);
    EXPECT_NEAR(moment.dot(downhill) + sum * 0.5 * tilt, 2 * r * r * tilt, 1e-5);
    EXPECT_NEAR(moment.dot(downhill.cross(Vec3::UnitZ())), 0, 1e-9);
  }
}

}  // namespace
