// SPDX-License-Identifier: MIT
#include <array>

#include "lanes/ground.hpp"
#include "muro/toolkit/rotations.hpp"
#include "terrain_testing.hpp"

namespace muro::native {
namespace {

using testing::Randoms, testing::hills, testing::rocks;

constexpr ShapeKind kinds[] = {ShapeKind::box, ShapeKind::sphere, ShapeKind::cylinder, ShapeKind::capsule};

std::string text_of(const std::vector<ContactPoint>& points) {
  std::ostringstream out;
  out.precision(12);
  for (const ContactPoint& p : points)
    out << "\n  at " << p.point.transpose() << ", depth " << p.depth << " along " << p.normal.transpose();
  return out.str();
}

/// Expects a plane and a heightmap of that plane to give the same points for random shapes, whatever the grid.
void expect_plane(const testing::Ground& ground, const Pose& plane_pose, double bound, unsigned seed) {
  const TransformedShape plane = transformed(Shape::plane(), plane_pose);
  Randoms random(seed);
  int touching = 0;
  for (int i = 0; i < 4000; ++i) {
    const Shape shape = random.shape(kinds[i % 4]);
    const bool lies = random.below(3) == 0;
    const Quat turn = lies ? Quat(plane_pose.orientation * random.right_angles()) : random.rotation();
    TransformedShape solid = transformed(shape, {Vec3::Zero(), turn});
    const double reach = testing::extent(solid, -plane.axis());
    const Vec3 local(random.uniform(-2, 2), random.uniform(-2, 2), reach * random.uniform(0.6, 1.1));
    solid.centre = plane_pose * local;
    Manifold expected;
    collide_shapes(solid, plane, expected);
    const std::vector<ContactPoint> found = ground.contacts(solid);
    const std::vector<ContactPoint> planes(expected.points, expected.points + expected.count);
    const auto holds = [&](const std::vector<ContactPoint>& all, const ContactPoint& e) {
      return e.depth < 4 * bound || std::any_of(all.begin(), all.end(), [&](const ContactPoint& p) {
               return (p.point - e.point).norm() < bound && (p.normal - e.normal).norm() < bound &&
                      std::abs(p.depth - e.depth) < bound;
             });
    };
    for (const ContactPoint& p : planes)
      EXPECT_TRUE(holds(found, p)) << "kind " << int(shape.kind) << ", " << i << text_of(found) << text_of({p});
    for (const ContactPoint& p : found)
      EXPECT_TRUE(holds(planes, p)) << "kind " << int(shape.kind) << ", " << i << text_of({p}) << text_of(planes);
    touching += expected.count > 0;
  }
  EXPECT_GT(touching, 2000);
}

TEST(Terrain, ThatIsFlatGivesEveryShapeThePointsThatItHasOnAPlane) {
  expect_plane(testing::Ground(12, 12, 25, 25, [](double, double) { return 0; }), {}, 1e-9, 1);
  const Pose pose{{1, -2, 0.5}, from_rpy(0.1, -0.2, 2)};
  expect_plane(testing::Ground(
                   14, 12, 9, 41, [](double, double) { return 0; }, pose),
               pose, 1e-9, 2);
}

TEST(Terrain, ThatIsAnInclinedPlaneByItsHeightsGivesThePointsOfThatPlane) {
  const Vec3 normal = Vec3(-0.3, 0.2, 1).normalized();
  const Pose plane{{0, 0, 0.1}, turn_between(Vec3::UnitZ(), normal)};
  expect_plane(testing::Ground(14, 14, 29, 57, [](double x, double y) { return 0.1 + 0.3 * x - 0.2 * y; }), plane, 2e-5,
               3);
}

/// Expects that the lift of a moving shape changes no faster than the ground rises, except for `jump` (m): there are no
/// gaps between triangles, and no edges where there are none.
void expect_steady(const testing::Ground& ground, const Shape& shape, double steepest, double jump, unsigned seed) {
  Randoms random(seed);
  constexpr double step = 2e-4;  // m
  double worst = 0;
  for (int path = 0; path < 60; ++path) {
    const double heading = random.uniform(-M_PI, M_PI);
    const Vec3 way = step * Vec3(std::cos(heading), std::sin(heading), 0);
    const Quat turn = shape.kind == ShapeKind::cylinder ? from_rpy(M_PI / 2, 0, heading) : Quat(random.rotation());
    TransformedShape solid = transformed(shape, {{random.uniform(-4, 4), random.uniform(-4, 4), 0}, turn});
    double before = -1;
    for (int i = 0; i < 3000; ++i) {
      const double ground_height = ground.map.ground_at(solid.centre.x(), solid.centre.y())->height;
      if (before < 0 || before > 0.03) {
        solid.centre.z() = 0;
        solid.centre.z() = ground_height + testing::extent(solid, -Vec3::UnitZ());
        solid.centre.z() += ground.lift(solid) - 0.004;
        before = ground.lift(solid);
      }
      solid.centre += way;
      const double now = ground.lift(solid);
      if (now > 0 && before > 0) worst = std::max(worst, std::abs(now - before) - steepest * step);
      before = now > 0 ? now : -1;
    }
  }
  EXPECT_LT(worst, jump);
}

TEST(Terrain, LiftsBallsAndWheelsSteadilyOverHills) {
  for (const std::uint32_t nodes : {13U, 25U, 201U}) {
    const testing::Ground ground = hills(nodes);
    expect_steady(ground, Shape::sphere(0.2), 0.5, 1e-3, 11);
    expect_steady(ground, Shape::cylinder(0.2, 0.1), 0.5, 1e-3, 12);
  }
}

TEST(Terrain, LiftsBallsSteadilyOverRocks) { expect_steady(rocks(3), Shape::sphere(0.3), 1.5, 1e-3, 13); }

TEST(Terrain, PushesUpWhatIsDeepInIt) {
  const testing::Ground ground = hills();
  Randoms random(5);
  for (int i = 0; i < 400; ++i) {
    const Shape shape = random.shape(kinds[i % 4]);
    const double x = random.uniform(-3, 3), y = random.uniform(-3, 3);
    const double depth = random.uniform(1, 5);
    const TransformedShape solid = transformed(
        shape, {{x, y, ground.map.ground_at(x, y)->height - half_lengths(shape).norm() - depth}, random.rotation()});
    const std::vector<ContactPoint> points = ground.contacts(solid);
    ASSERT_FALSE(points.empty()) << i;
    for (const ContactPoint& p : points) {
      EXPECT_GT(p.normal.z(), 0.8) << i;
      EXPECT_GT(p.depth, 0.5 * depth) << i;
    }
  }
}

TEST(Terrain, EndsAtItsRim) {
  const testing::Ground ground(2, 2, 5, 5, [](double, double) { return 0; });
  const auto ball = [&](double x, double z) {
    return ground.contacts(transformed(Shape::sphere(0.5), {{x, 0.1, z}, Quat::Identity()}));
  };
  ASSERT_EQ(ball(0.9, 0.45).size(), 1u);
  const std::vector<ContactPoint> on_rim = ball(1.3, 0.3);
  ASSERT_EQ(on_rim.size(), 1u);
  EXPECT_LT((on_rim[0].normal - Vec3(1, 0, 1).normalized()).norm(), 1e-9);
  EXPECT_NEAR(on_rim[0].depth, 0.5 - std::hypot(0.3, 0.3), 1e-9);
  EXPECT_TRUE(ball(1.51, 0.1).empty());
  EXPECT_TRUE(ball(1.4, -0.4).empty());
}

TEST(Terrain, LiftsWheelsByWhatFewOperationsTellAsByAllThatIsNear) {
  double worst = 0;
  int told = 0, edges = 0;
  for (const std::uint32_t nodes : {25U, 121U, 241U}) {
    const testing::Ground ground = hills(nodes);
    Randoms random(9);
    for (int i = 0; i < 4000; ++i) {
      const double x = random.uniform(-5, 5), y = random.uniform(-5, 5);
      const auto [height, normal] = *ground.map.ground_at(x, y);
      const Quat turn = from_rpy(M_PI / 2 + random.uniform(-0.01, 0.01), 0, random.uniform(-3, 3));
      const Pose pose{{x, y, height + 0.1 / normal.z() - 5e-4}, turn_between(Vec3::UnitZ(), normal) * turn};
      const TransformedShape wheel = transformed(kernel_shape_of(Shape::cylinder(0.1, 0.12)), pose);
      std::vector<ContactPoint> few = ground.contacts(wheel), all;
      collide_terrain(wheel, *ground.terrain, all, true);
      double low = 0, high = 0;
      for (const ContactPoint& p : few) low = std::max(low, p.depth / p.normal.z());
      for (const ContactPoint& p : all) high = std::max(high, p.depth / p.normal.z());
      worst = std::max(worst, std::abs(low - high));
      told += !few.empty();
      edges += few.size() > 2;
    }
  }
  EXPECT_LT(worst, 2e-4) << "m";
  EXPECT_GT(told, 5000);
  EXPECT_GT(edges, 1000) << "edges between the rims are among them";
}

/// Eight robots of one body each, with the same shape, on a heightmap.
struct Eight {
  static constexpr int most = 8, words = 1, stride = sizeof(Contact) / sizeof(double);
  KernelShape shape;
  native::Ground ground;
  Pose poses[8];
  std::array<double, most * stride> contacts[8] = {};
  std::array<double, words> signatures[8];
  std::uint8_t left[1] = {};  ///< by slot
  double clearances[8][numbers_of_clearance] = {};

  /// Returns the numbers of the first contacts of a robot.
  std::vector<double> numbers(int robot, std::size_t count) const {
    return {contacts[robot].data(), contacts[robot].data() + count * stride};
  }

  unsigned touch(const GroundKernels& kernels, int first, int count) {
    GroundBatch batch;
    batch.shapes = &shape;
    batch.shape_count = 1;
    batch.grounds = &ground;
    batch.ground_count = 1;
    batch.contact_stride = stride;
    batch.used = count;
    left[0] = 0;
    batch.left = left;
    for (int i = 0; i < count; ++i) {
      signatures[first + i].fill(-1);
      batch.poses[i].base = poses[first + i].position.data();
      batch.contacts[i] = contacts[first + i].data();
      batch.signatures[i] = signatures[first + i].data();
      batch.clearances[i] = clearances[first + i];
    }
    return kernels.find_contacts(batch);
  }
};

TEST(GroundKernel, GivesOnAHeightmapTheBitsOfEachRobotAloneAndOfPairs) {
  const testing::Ground coarse = hills(), fine = hills(201),
                        turned(12, 12, 25, 25, [](double x, double y) { return 0.1 * std::sin(x + y); },
                               {{0.3, 0.1, 0.2}, from_rpy(0.05, 0.1, 1)});
  Randoms random(8);
  const lane::Isa best = lane::best_isa();
  int told = 0, left = 0;
  for (int k = 0; k < 3000; ++k) {
    const testing::Ground& ground = k % 3 == 0 ? turned : k % 3 == 1 ? coarse : fine;
    Shape shape = k % 2 == 0 ? Shape::sphere(0.2) : Shape::cylinder(0.2, 0.1);
    if (k % 7 == 0) shape = Shape::box({0.5, 0.3, 0.2});
    Eight together;
    together.shape = kernel_shape_of(shape);
    together.ground.terrain = &ground.terrain->grid();
    for (Pose& p : together.poses) {
      const double x = random.uniform(-5, 5), y = random.uniform(-5, 5);
      const Vec3 up(x, y, ground.map.ground_at(x, y)->height + 0.199 + (k % 7 == 0 ? random.uniform(0, 0.3) : 0));
      p = ground.terrain->pose() * Pose{up, from_rpy(M_PI / 2 + random.uniform(-0.1, 0.1), 0, random.uniform(-3, 3))};
    }
    Eight alone = together, base = together;
    const unsigned bits = together.touch(ground_kernels_for(best), 0, 8);
    EXPECT_EQ(bits, base.touch(ground_kernels_for(lane::Isa::base), 0, 8));
    for (int i = 0; i < 8; ++i) {
      const unsigned own = alone.touch(ground_kernels_for(best), i, 1);
      ASSERT_EQ(own >> 8, bits >> (8 + i) & 1);
      if (own >> 8 != 0) {
        ++left;
        continue;
      }
      ++told;
      ASSERT_EQ(together.signatures[i], alone.signatures[i]);
      ASSERT_EQ(together.signatures[i], base.signatures[i]);
      const std::vector<ContactPoint> points = ground.contacts(transformed(together.shape, together.poses[i]));
      ASSERT_EQ(points.size(), std::size_t(std::popcount(std::uint64_t(together.signatures[i][0]))));
      ASSERT_EQ(together.numbers(i, points.size()), alone.numbers(i, points.size()));
      ASSERT_EQ(together.numbers(i, points.size()), base.numbers(i, points.size()));
      for (std::size_t n = 0; n < points.size(); ++n) {
        const double* const contact = together.contacts[i].data() + n * Eight::stride;
        EXPECT_EQ(points[n].point, Vec3::Map(contact));
        EXPECT_EQ(points[n].normal, Vec3::Map(contact + normal_number));
        EXPECT_EQ(points[n].depth, contact[depth_number]);
      }
    }
  }
  EXPECT_GT(told, 3000);
  EXPECT_GT(left, 100) << "both ways are tried";
}

TEST(GroundKernel, TellsOfBoxesOnTheirWayNoMoreThanOfThoseAtRest) {
  const testing::Ground grounds[] = {hills(), hills(121), rocks(5)};
  for (const testing::Ground& ground : grounds) {
    Randoms random(21);
    Eight boxes;
    boxes.shape = kernel_shape_of(Shape::box({0.35, 0.25, 0.12}));
    boxes.ground.terrain = &ground.terrain->grid();
    int clear = 0, left = 0;
    for (int k = 0; k < 1500; ++k) {
      for (Pose& p : boxes.poses) {
        if (k % 250 == 0) {
          const double x = random.uniform(-5, 5), y = random.uniform(-5, 5);
          p = {{x, y, ground.map.ground_at(x, y)->height + random.uniform(0.1, 0.3)}, from_rpy(0, 0, 3 * x)};
        }
        p.position += 2e-3 * Vec3(random.uniform(-1, 1), random.uniform(-1, 1), random.uniform(-1, 0.98));
        p.orientation = from_rpy(0.01 * random.uniform(-1, 1), 0, 0.01) * p.orientation;
      }
      Eight fresh = boxes;
      std::fill_n(fresh.clearances[0], 8 * numbers_of_clearance, 0.0);
      const unsigned kept = boxes.touch(ground_kernels_for(lane::best_isa()), 0, 8) >> 8,
                     anew = fresh.touch(ground_kernels_for(lane::best_isa()), 0, 8) >> 8;
      ASSERT_EQ(kept & ~anew, 0U) << "left though it is clear";
      for (int i = 0; i < 8; ++i) {
        left += int(kept >> i & 1);
        if (kept >> i & 1) continue;
        ++clear;
        std::vector<ContactPoint> all;
        collide_terrain(transformed(boxes.shape, boxes.poses[i]), *ground.terrain, all, true);
        ASSERT_TRUE(all.empty()) << "it touches" << text_of(all);
      }
    }
    EXPECT_GT(clear, 1000);
    EXPECT_GT(left, 500);
  }
}

}  // namespace
}  // namespace muro::native
