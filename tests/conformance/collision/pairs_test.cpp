// SPDX-License-Identifier: MIT
// Pairs of shapes whose contacts have a closed form, in every collision algorithm.
#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/collision/touching.hpp"

namespace muro {
namespace {

using test::Accuracy;
using test::contacts_of;
using test::deepest;

struct EveryCollision : ::testing::TestWithParam<std::string> {
  Accuracy extension = test::accuracy_of(GetParam());

  /// Checks the deepest contact of `shape` with `scenery`.
  void expect_deepest(const Shape& shape, const Pose& at, const Shape& scenery, const Pose& place, const Vec3& point,
                      const Vec3& normal, double depth) {
    const std::vector<Contact> contacts = contacts_of(GetParam(), shape, at, scenery, place);
    ASSERT_GT(contacts.size(), 0u);
    const Contact& c = deepest(contacts);
    EXPECT_NEAR(c.depth, depth, extension.depth);
    EXPECT_LT((c.normal - normal).norm(), extension.normal) << c.normal.transpose();
    EXPECT_LT((c.point - point).norm(), extension.point) << c.point.transpose();
  }
  /// Checks that the contacts are at these points, once each, all with this depth and normal.
  void expect_points(const Shape& shape, const Pose& at, const Shape& scenery, const Pose& place, double depth,
                     const Vec3& normal, const std::vector<Vec3>& points) {
    const std::vector<Contact> contacts = contacts_of(GetParam(), shape, at, scenery, place);
    EXPECT_EQ(contacts.size(), points.size());
    for (const Vec3& p : points)
      EXPECT_EQ(std::count_if(contacts.begin(), contacts.end(),
                              [&](const Contact& c) { return (c.point - p).norm() < extension.point; }),
                1)
          << p.transpose() << " among " << test::text_of(contacts);
    for (const Contact& c : contacts) {
      EXPECT_NEAR(c.depth, depth, extension.depth) << c.point.transpose();
      EXPECT_LT((c.normal - normal).norm(), extension.normal) << c.normal.transpose();
    }
  }
};

Pose at(double x, double y, double z, const Quat& q = Quat::Identity()) { return {{x, y, z}, q}; }

const Shape unit_box = Shape::box({1, 1, 1}), slab = Shape::box({10, 10, 1}), ball = Shape::sphere(0.5),
            plane = Shape::plane();
const Pose origin = at(0, 0, 0), below = at(0, 0, -0.5);
const Quat on_side = from_rpy(M_PI / 2, 0, 0);
constexpr double deep = 0.01, mid = -0.005;
const Vec3 up(0, 0, 1);

TEST_P(EveryCollision, SpheresMeetOnTheLineOfTheirCentres) {
  const Vec3 away = Vec3(1, 2, -2) / 3;
  expect_deepest(ball, {1.1 * away, Quat::Identity()}, Shape::sphere(0.7), origin, 0.65 * away, away, 0.1);
  EXPECT_EQ(contacts_of(GetParam(), ball, {1.2001 * away, Quat::Identity()}, Shape::sphere(0.7), origin).size(), 0u);
}

TEST_P(EveryCollision, SphereMeetsABoxAtFaceEdgeAndCorner) {
  const Shape box = Shape::box({2, 2, 2});
  expect_deepest(ball, at(0.2, 0.3, 1.4), box, origin, {0.2, 0.3, 0.95}, up, 0.1);
  const Vec3 edge = Vec3(1, 0, 1).normalized();
  expect_deepest(ball, {Vec3(1, 0.2, 1) + 0.4 * edge, Quat::Identity()}, box, origin, Vec3(1, 0.2, 1) - 0.05 * edge,
                 edge, 0.1);
  const Vec3 corner = Vec3(1, 1, 1).normalized();
  expect_deepest(ball, {Vec3(1, 1, 1) + 0.4 * corner, Quat::Identity()}, box, origin, Vec3(1, 1, 1) - 0.05 * corner,
                 corner, 0.1);
}

TEST_P(EveryCollision, SphereMeetsPlaneCylinderAndCapsule) {
  expect_deepest(ball, at(3, 4, 0.4), plane, origin, {3, 4, -0.05}, up, 0.1);
  expect_deepest(ball, at(0, 1.4, 0.3), Shape::cylinder(1, 2), origin, {0, 0.95, 0.3}, {0, 1, 0}, 0.1);
  expect_deepest(ball, at(0.2, 0, 1.4), Shape::cylinder(1, 2), origin, {0.2, 0, 0.95}, up, 0.1);
  expect_deepest(ball, at(0.6, 0, 1), Shape::capsule(0.5, 4), origin, {0.3, 0, 1}, {1, 0, 0}, 0.4);
}

TEST_P(EveryCollision, BoxRestsOnFourCornersOnAPlaneAndOnABox) {
  const Pose pose = at(0.3, 0.2, 0.5 - deep);
  const std::vector<Vec3> corners{{1.3, 0.7, mid}, {1.3, -0.3, mid}, {-0.7, 0.7, mid}, {-0.7, -0.3, mid}};
  expect_points(Shape::box({2, 1, 1}), pose, plane, origin, deep, up, corners);
  expect_points(Shape::box({2, 1, 1}), pose, slab, below, deep, up, corners);
}

TEST_P(EveryCollision, BoxOnItsEdgeRestsOnTwoPoints) {
  const Pose pose = at(0, 0, std::sqrt(0.5) - deep, from_rpy(M_PI / 4, 0, 0));
  const std::vector<Vec3> ends{{1, 0, mid}, {-1, 0, mid}};
  expect_points(Shape::box({2, 1, 1}), pose, plane, origin, deep, up, ends);
  expect_points(Shape::box({2, 1, 1}), pose, slab, below, deep, up, ends);
}

TEST_P(EveryCollision, BoxEdgesThatCrossGiveTheirCommonPerpendicular) {
  const double ridge = std::sqrt(2.0) / 2;
  expect_points(Shape::box({1, 4, 1}), at(0.2, -0.3, 2 * ridge - 0.05, from_rpy(0, M_PI / 4, 0)), Shape::box({4, 1, 1}),
                at(0, 0, 0, from_rpy(M_PI / 4, 0, 0)), 0.05, up, {{0.2, 0, ridge - 0.025}});
}

TEST_P(EveryCollision, BoxCornerOnAFaceIsOnePoint) {
  const Quat on_corner = turn_between(Vec3(1, 1, 1).normalized(), -up);
  expect_points(unit_box, at(0.1, 0.2, std::sqrt(3.0) / 2 - 0.02, on_corner), slab, below, 0.02, up,
                {{0.1, 0.2, -0.01}});
}

TEST_P(EveryCollision, CylinderStandsOnFourPointsOfItsRim) {
  const std::vector<Vec3> rim{{0.4, 0, mid}, {-0.4, 0, mid}, {0, 0.4, mid}, {0, -0.4, mid}};
  const Shape cylinder = Shape::cylinder(0.4, 1);
  for (const auto& [scenery, place] : {std::pair(plane, origin), std::pair(slab, below)}) {
    const std::vector<Contact> contacts = contacts_of(GetParam(), cylinder, at(0, 0, 0.5 - deep), scenery, place);
    ASSERT_GE(contacts.size(), 3u);
    Vec3 middle = Vec3::Zero();
    for (const Contact& c : contacts) {
      EXPECT_NEAR(c.depth, deep, extension.depth);
      EXPECT_LT((c.normal - up).norm(), extension.normal);
      EXPECT_NEAR(c.point.head<2>().norm(), 0.4, extension.point);
      EXPECT_NEAR(c.point.z(), mid, extension.point);
      middle += c.point / double(contacts.size());
    }
    EXPECT_LT(middle.head<2>().norm(), 0.2) << "the points are around the axis";
  }
}

TEST_P(EveryCollision, LyingCylinderRestsOnTheEndsOfItsLowestLine) {
  const Pose pose = at(1, 2, 0.3 - deep, on_side);
  const std::vector<Vec3> ends{{1, 1.5, mid}, {1, 2.5, mid}};
  expect_points(Shape::cylinder(0.3, 1), pose, plane, origin, deep, up, ends);
  expect_points(Shape::cylinder(0.3, 1), pose, slab, below, deep, up, ends);
}

TEST_P(EveryCollision, LyingCapsuleRestsOnBothEnds) {
  const Pose pose = at(0, 0, 0.2 - deep, on_side);
  const std::vector<Vec3> ends{{0, 0.5, mid}, {0, -0.5, mid}};
  expect_points(Shape::capsule(0.2, 1), pose, plane, origin, deep, up, ends);
  expect_points(Shape::capsule(0.2, 1), pose, slab, below, deep, up, ends);
}

TEST_P(EveryCollision, CapsulesMeetWhereTheirAxesAreNearest) {
  const Shape capsule = Shape::capsule(0.5, 4);
  expect_deepest(capsule, at(0.9, 0.7, 0.4, on_side), capsule, origin, {0.45, 0, 0.4}, {1, 0, 0}, 0.1);
  expect_deepest(capsule, at(0, 0, 4.8), capsule, origin, {0, 0, 2.4}, up, 0.2);
}

TEST_P(EveryCollision, CrossedCylindersMeetBetweenTheirAxes) {
  expect_points(Shape::cylinder(0.3, 4), at(0.7, 0.4, 0.3, on_side), Shape::cylinder(0.5, 4), origin, 0.1, {1, 0, 0},
                {{0.45, 0, 0.3}});
}

TEST_P(EveryCollision, AContactHasFrictionAndRestitutionOfThePair) {
  Shape crate = unit_box, floor = slab;
  crate.surface.friction = 0.4, crate.surface.restitution = 0.3;
  floor.surface.friction = 0.9, floor.surface.restitution = 0.1;
  for (const Contact& c : contacts_of(GetParam(), crate, at(0, 0, 0.49), floor, below)) {
    EXPECT_DOUBLE_EQ(c.surface.friction, 0.4);
    EXPECT_DOUBLE_EQ(c.surface.restitution, 0.3);
  }
}

INSTANTIATE_TEST_SUITE_P(Conformance, EveryCollision, ::testing::ValuesIn(test::algorithms_of("collision")),
                         test::name_of);

}  // namespace
}  // namespace muro
