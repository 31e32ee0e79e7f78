// SPDX-License-Identifier: MIT
#include "intersect.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "test_scene.hpp"

namespace muro::raycast {
namespace {

using std::numbers::pi;

constexpr double degree = pi / 180;
constexpr double exact = 1e-9;

using rays::never;

/// S: double, or a lane of doubles.
template <class S>
S enter_of(const Shape& s, const lane::V3<S>& o, const lane::V3<S>& d) {
  switch (s.kind) {
    case ShapeKind::box:
      return rays::enter_box<S>(o, {S(1) / d.x, S(1) / d.y, S(1) / d.z}, s.size.x() / 2, s.size.y() / 2,
                                s.size.z() / 2);
    case ShapeKind::sphere:
      return rays::enter_ball(o, d, s.size.x());
    case ShapeKind::cylinder:
      return rays::enter_cylinder(o, d, s.size.x(), s.size.z() / 2);
    case ShapeKind::capsule:
      return rays::enter_capsule(o, d, s.size.x(), s.size.z() / 2);
    case ShapeKind::plane:
      return rays::enter_half_space(o.z, d.z);
    case ShapeKind::mesh:
    case ShapeKind::heightmap:
      break;
  }
  return S(never);
}

double enter(const Shape& s, const Vec3& o, const Vec3& d) {
  return enter_of<double>(s, {o.x(), o.y(), o.z()}, {d.x(), d.y(), d.z()});
}

double enter_half_space(double height, double dz) { return rays::enter_half_space(height, dz); }

TEST(Intersection, AgreesWithTheDistanceToAWallAtAnyIncidence) {
  for (const double incidence : {0.0, 45 * degree, 80 * degree})
    for (const double distance : {0.1, 5.6, 300.0}) {
      const Vec3 direction(std::cos(incidence), std::sin(incidence), 0);
      const Vec3 start(-distance, -distance * std::tan(incidence), 0.2);  // aims at the middle of the face
      EXPECT_NEAR(enter(Shape::box({2, 2, 2}), start - Vec3(1, 0, 0), direction), distance / std::cos(incidence),
                  exact);
    }
}

TEST(Intersection, AgreesWithTheDistanceToASphereAtAnyIncidence) {
  // A ray that meets the surface at the angle a passes the centre at r sin a (law of sines).
  for (const double incidence : {0.0, 45 * degree, 80 * degree})
    for (const double radius : {0.05, 1.0, 20.0})
      for (const double distance : {1.0, 50.0}) {
        const double centre = distance + radius, miss = radius * std::sin(incidence);
        const double aim = std::asin(miss / centre);
        const double expected = centre * std::cos(aim) - radius * std::cos(incidence);
        EXPECT_NEAR(enter(Shape::sphere(radius), {-centre, 0, 0}, {std::cos(aim), std::sin(aim), 0}), expected, exact);
      }
}

TEST(Intersection, AgreesWithTheDistanceToTheSideOfACylinder) {
  for (const double incidence : {0.0, 45 * degree, 80 * degree})
    for (const double elevation : {0.0, 45 * degree, -80 * degree})
      for (const double radius : {0.05, 1.0}) {
        const double centre = 3 + radius, aim = std::asin(radius * std::sin(incidence) / centre);
        const double flat = centre * std::cos(aim) - radius * std::cos(incidence);
        const Vec3 direction(std::cos(elevation) * std::cos(aim), std::cos(elevation) * std::sin(aim),
                             std::sin(elevation));
        const Vec3 start(-centre, 0, -flat * std::tan(elevation));
        for (const Shape& s : {Shape::cylinder(radius, 1), Shape::capsule(radius, 1)})
          EXPECT_NEAR(enter(s, start, direction), flat / std::cos(elevation), exact);
      }
}

TEST(Intersection, AgreesWithTheDistanceToTheEndOfACylinderAtAnyIncidence) {
  for (const double incidence : {0.0, 45 * degree, 80 * degree})
    for (const int side : {-1, 1}) {
      const Vec3 direction(std::sin(incidence), 0, -side * std::cos(incidence));
      const Vec3 start(0.1 - 2 * std::tan(incidence), 0.2, side * 2.5);
      EXPECT_NEAR(enter(Shape::cylinder(0.5, 1), start, direction), 2 / std::cos(incidence), exact);
    }
}

TEST(Intersection, AgreesWithTheDistanceToTheRoundEndOfACapsule) {
  const Shape capsule = Shape::capsule(0.3, 1.4);
  EXPECT_NEAR(enter(capsule, {0, 0, 5}, {0, 0, -1}), 4, exact);
  EXPECT_NEAR(enter(capsule, {0, 0, -5}, {0, 0, 1}), 4, exact);
  // beside the axis, parallel to it: the half ball is 0.7 + sqrt(r^2 - x^2) high
  EXPECT_NEAR(enter(capsule, {0.18, 0, 5}, {0, 0, -1}), 5 - 0.7 - 0.24, exact);
  // through the half ball, above the straight part
  EXPECT_NEAR(enter(capsule, {-3, 0, 0.88}, {1, 0, 0}), 3 - 0.24, exact);
}

TEST(Intersection, AgreesWithTheDistanceToAPlaneAtAnyIncidence) {
  for (const double incidence : {0.0, 45 * degree, 80 * degree, 89.9 * degree})
    EXPECT_NEAR(enter_half_space(1.3, -std::cos(incidence)), 1.3 / std::cos(incidence),
                exact * std::max(1.0, 1e-3 / std::cos(incidence)));
  EXPECT_EQ(enter_half_space(1.3, 0.0), never);
  EXPECT_EQ(enter_half_space(1.3, 0.5), never);
}

TEST(Intersection, MissesWhatLiesBehind) {
  for (const Shape& s : {Shape::box({1, 1, 1}), Shape::sphere(0.5), Shape::cylinder(0.5, 1), Shape::capsule(0.5, 1)}) {
    EXPECT_EQ(enter(s, {2, 0, 0}, {1, 0, 0}), never);
    EXPECT_EQ(enter(s, {0, 0, 3}, {0, 0, 1}), never);
    EXPECT_EQ(enter(s, {2, 0.1, 0}, Vec3(1, 0.2, 0.1).normalized()), never);
  }
}

TEST(Intersection, IsZeroForARayThatStartsInside) {
  test::Dice dice(3);
  for (const Shape& s : {Shape::box({1, 1, 1}), Shape::sphere(0.5), Shape::cylinder(0.5, 1), Shape::capsule(0.5, 1)})
    for (int i = 0; i < 200; ++i) {
      EXPECT_EQ(enter(s, dice.in_box(0.28), dice.in_box(1).normalized()), 0);
      EXPECT_EQ(enter(s, dice.in_box(0.28), Vec3::Unit(i % 3)), 0);
      EXPECT_EQ(enter(s, Vec3::Zero(), -Vec3::Unit(i % 3)), 0);
    }
  EXPECT_EQ(enter_half_space(-0.1, 1.0), 0);
  EXPECT_EQ(enter_half_space(0.0, 1.0), 0);
}

TEST(Intersection, CountsAFaceAsPartOfABox) {
  const Shape box = Shape::box({2, 2, 2});
  for (int along = 0; along < 3; ++along)
    for (int across = 0; across < 3; ++across) {
      if (along == across) continue;
      for (const int side : {-1, 1})
        for (const int sense : {-1, 1}) {
          Vec3 start = side * Vec3::Unit(across) - 4.0 * sense * Vec3::Unit(along);
          Vec3 direction = sense * Vec3::Unit(along);
          EXPECT_NEAR(enter(box, start, direction), 3, exact) << "a ray in the face";
          for (int k = 0; k < 3; ++k)
            if (direction[k] == 0) direction[k] = -0.0;
          EXPECT_NEAR(enter(box, start, direction), 3, exact) << "negative zeros";
          start += side * 1e-9 * Vec3::Unit(across);
          EXPECT_EQ(enter(box, start, direction), never) << "a ray just beside the face";
        }
    }
  EXPECT_NEAR(enter(box, {-4, 1, 1}, {1, 0, 0}), 3, exact) << "a ray in an edge";
}

TEST(Intersection, CountsATangentAsAHit) {
  // 0.75, 3 and 5 are exact in binary, and so is the discriminant 0.
  EXPECT_NEAR(enter(Shape::sphere(0.75), {-3, 0.75, 0}, {1, 0, 0}), 3, exact);
  EXPECT_NEAR(enter(Shape::cylinder(0.75, 2), {-3, -0.75, 0.5}, {1, 0, 0}), 3, exact);
  EXPECT_NEAR(enter(Shape::capsule(0.75, 2), {-3, 0.75, 0.5}, {1, 0, 0}), 3, exact);
  for (const Shape& s : {Shape::sphere(0.75), Shape::cylinder(0.75, 2), Shape::capsule(0.75, 2)})
    EXPECT_EQ(enter(s, {-3, 0.75 + 1e-12, 0}, {1, 0, 0}), never);
}

TEST(Intersection, FollowsAGrazingRayAsFarAsItsConditionAllows) {
  // Just inside the rim the distance is 3 - sqrt(r^2 - y^2); an error e of y becomes e y / sqrt(r^2 - y^2).
  for (const double gap : {1e-3, 1e-6, 1e-9}) {
    const double y = 0.75 - gap;
    const double half = std::sqrt(gap * (0.75 + y));  // half length of the chord
    EXPECT_NEAR(enter(Shape::sphere(0.75), {-3, y, 0}, {1, 0, 0}), 3 - half, 1e-15 / half);
    EXPECT_NEAR(enter(Shape::cylinder(0.75, 2), {-3, y, 0}, {1, 0, 0}), 3 - half, 1e-15 / half);
  }
}

TEST(Intersection, HandlesRaysAlongTheAxisOfACylinder) {
  const Shape cylinder = Shape::cylinder(0.5, 2);
  EXPECT_NEAR(enter(cylinder, {0.3, 0.3, 4}, {0, 0, -1}), 3, exact);
  EXPECT_NEAR(enter(cylinder, {0.5, 0, -4}, {0, 0, 1}), 3, exact) << "in the side";
  EXPECT_EQ(enter(cylinder, {0.5 + 1e-9, 0, 4}, {0, 0, -1}), never);
  EXPECT_EQ(enter(cylinder, {0.3, 0.3, -4}, {0, 0, -1}), never);
  EXPECT_EQ(enter(cylinder, {0.3, 0.3, 0}, {0, 0, 1}), 0);
  // nearly parallel, due to the rounding of a rotation
  for (const double tilt : {1e-17, 1e-12, 1e-170})
    EXPECT_NEAR(enter(cylinder, {0.3, 0.3, 4}, {tilt, -tilt, -1}), 3, exact);
}

TEST(Intersection, LiesInTheFlatEndOfACylinderForARayInIt) {
  EXPECT_NEAR(enter(Shape::cylinder(0.5, 2), {-3, 0, 1}, {1, 0, 0}), 2.5, exact);
  EXPECT_EQ(enter(Shape::cylinder(0.5, 2), {-3, 0, 1 + 1e-12}, {1, 0, 0}), never);
}

TEST(Intersection, AgreesWithAReferenceInLongDouble) {
  test::Dice dice(11);
  int hits = 0;
  for (int i = 0; i < 40000; ++i) {
    const Shape s = dice.shape(0.1, 2);
    const Vec3 start = dice.in_box(4), target = dice.in_box(1.5);
    const Vec3 d = (target - start).normalized();
    const long double expected = test::Reference::enter(s, {start.x(), start.y(), start.z()}, {d.x(), d.y(), d.z()});
    const double found = enter(s, start, d);
    hits += std::isfinite(found);
    if (std::isinf(expected))
      EXPECT_EQ(found, never);
    else
      EXPECT_NEAR(found, double(expected), exact);
  }
  EXPECT_GT(hits, 10000);
}

TEST(Intersection, GivesEachValueOfALaneTheBitsOfADouble) {
  using Lane = lane::Double8;
  test::Dice dice(12);
  for (int round = 0; round < 2000; ++round) {
    const Shape shape = round % 5 == 4 ? Shape::plane() : dice.shape(0.1, 2);
    Vec3 o[8], d[8];
    lane::V3<Lane> origins, directions;
    for (int i = 0; i < 8; ++i) {
      o[i] = round % 3 == 0 ? dice.in_box(0.5) : dice.in_box(4);
      d[i] = i == 0 ? Vec3::Unit(round % 3) : Vec3((dice.in_box(1.5) - o[i]).normalized());
      if (i == 1) d[i] = Vec3(0, -0.0, -1);
      origins.x.set(i, o[i].x()), origins.y.set(i, o[i].y()), origins.z.set(i, o[i].z());
      directions.x.set(i, d[i].x()), directions.y.set(i, d[i].y()), directions.z.set(i, d[i].z());
    }
    const Lane found = enter_of<Lane>(shape, origins, directions);
    for (int i = 0; i < 8; ++i) EXPECT_EQ(found[i], enter(shape, o[i], d[i])) << "round " << round << " value " << i;
  }
}

}  // namespace
}  // namespace muro::raycast
