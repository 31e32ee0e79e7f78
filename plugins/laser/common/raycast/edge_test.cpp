// SPDX-License-Identifier: MIT
// Rays that pass edges at less than the resolution of floats, and equal bits from every build of the kernels.
#include <gtest/gtest.h>

#include <cstring>
#include <numbers>

#include "muro/toolkit/rotations.hpp"
#include "ray_caster.hpp"
#include "test_scene.hpp"

namespace muro::raycast {
namespace {

using std::numbers::pi;
using test::Dice;
using test::Reference;
using test::TestScene;

std::vector<lane::Isa> instruction_sets() {
  std::vector<lane::Isa> all = {lane::Isa::base};
  if (lane::best_isa() >= lane::Isa::avx2) all.push_back(lane::Isa::avx2);
  if (lane::best_isa() >= lane::Isa::avx512) all.push_back(lane::Isa::avx512);
  return all;
}

/// Returns a pattern of one ray along a direction (unit), as precisely as angles allow.
std::vector<double> angles_of(const Vec3& d) {
  return {std::atan2(d.y(), d.x()), std::asin(std::clamp(d.z(), -1.0, 1.0))};
}

struct Outline {
  Vec3 point;    ///< on the outline of the shape, as seen from the start
  Vec3 outward;  ///< unit; across the line of sight, away from the shape
};

/// Returns a point where the line of sight from `start` touches a shape at the origin that is not rotated.
Outline outline_of(const Shape& shape, const Vec3& start, Dice& dice) {
  const auto across = [&](const Vec3& point, const Vec3& away) {
    const Vec3 sight = (point - start).normalized();
    return Outline{point, (away - away.dot(sight) * sight).normalized()};
  };
  const double turn = dice.between(-pi, pi);
  switch (shape.kind) {
    case ShapeKind::sphere: {  // the circle of tangents
      const double r = shape.size.x(), far = start.norm();
      const Vec3 to = start / far, side = to.unitOrthogonal();
      const Vec3 away = std::cos(turn) * side + std::sin(turn) * to.cross(side);
      const Vec3 point = r * (r / far * to + std::sqrt(1 - r * r / (far * far)) * away);
      return across(point, point);
    }
    case ShapeKind::cylinder: {  // the tangent to the circle, at any height
      const double r = shape.size.x(), far = std::hypot(start.x(), start.y());
      const Vec3 to(start.x() / far, start.y() / far, 0), side(-to.y(), to.x(), 0);
      const double sense = turn < 0 ? -1 : 1;
      Vec3 point = r * (r / far * to + sense * std::sqrt(1 - r * r / (far * far)) * side);
      const Vec3 away = point;
      point.z() = dice.between(-0.45, 0.45) * shape.size.z();
      return across(point, away);
    }
    default: {  // an edge of a box between a visible and a hidden face
      const Vec3 half = 0.5 * shape.size;
      Vec3 point;
      const int along = int(dice.between(0, 3)), seen = (along + 1) % 3, hidden = (along + 2) % 3;
      point[along] = dice.between(-0.9, 0.9) * half[along];
      point[seen] = std::copysign(half[seen], start[seen]);
      point[hidden] = -std::copysign(half[hidden], start[hidden]);
      const double out =
          std::abs(start[hidden]) < half[hidden] ? (turn < 0 ? -1 : 1) : -std::copysign(1, start[hidden]);
      point[hidden] = out * half[hidden];
      return across(point, out * Vec3::Unit(hidden));
    }
  }
}

TEST(LaserEdge, DecidesInDoublesOnWhichSideOfAnEdgeARayPasses) {
  Dice dice(21);
  RayCaster caster;
  for (const lane::Isa isa : instruction_sets()) {
    int hits = 0, misses = 0;
    for (int round = 0; round < 400; ++round) {
      const Shape shape = round % 4 == 0   ? Shape::sphere(dice.between(0.1, 2))
                          : round % 4 == 1 ? Shape::cylinder(dice.between(0.1, 2), dice.between(0.5, 3))
                                           : Shape::box(Vec3(1, 1, 1) + 0.9 * dice.in_box(1));
      // from the side, between the ends, where outline_of expects the outline
      const double azimuth = dice.between(-pi, pi), far = dice.between(4, 25);
      Vec3 start(far * std::cos(azimuth), far * std::sin(azimuth), dice.between(-0.2, 0.2));
      if (shape.kind == ShapeKind::box && round % 4 == 2) start = far * dice.in_box(1).cwiseMax(0.3);
      const Outline outline = outline_of(shape, start, dice);
      Pose place = dice.pose(20);                                // pose of the whole arrangement
      if (round % 8 >= 4) place.orientation = Quat::Identity();  // a box fills its bounding box
      std::vector<double> angles;
      for (const double size : {1e-5, 1e-6, 1e-7, 1e-8, 1e-9, 1e-10, 1e-11})
        for (const int side : {-1, 1}) {
          const Vec3 aim = place.orientation * (outline.point + side * size * outline.outward - start);
          for (const double a : angles_of(aim.normalized())) angles.push_back(a);
        }
      const RayPattern pattern{std::span<const double>(angles)};
      TestScene scene;
      const ObjectId body = scene.add_scenery(shape, place);
      const Viewpoint from{{place * start, Quat::Identity()}, 100};
      SceneTable table;
      table.build(scene.index());
      std::vector<double> ranges(pattern.size());
      std::vector<ObjectId> found(pattern.size());
      caster.cast(scan_kernels_for(isa), table, from, pattern, ranges, found);
      for (std::uint32_t i = 0; i < pattern.size(); ++i) {
        const RayPacket& b = pattern.packets()[0];
        const Reference::Hit expected =
            Reference::cast(scene.index(), from.device, {b.x[i], b.y[i], b.z[i]}, 0, from.max_range, no_robot);
        EXPECT_EQ(found[i], expected.body) << "round " << round << " ray " << i;
        if (expected.body == no_object) {
          EXPECT_EQ(ranges[i], from.max_range);
        }
        hits += expected.body == body;
        misses += expected.body != body;
      }
    }
    EXPECT_GT(hits, 2000);
    EXPECT_GT(misses, 2000);
  }
}

TEST(LaserEdge, SeesTheNearerOfTwoFacesANanometreApart) {
  Dice dice(22);
  RayCaster caster;
  const RayPattern pattern(Grid{.min_angle = -0.4, .max_angle = 0.4, .columns = 64});
  for (const lane::Isa isa : instruction_sets())
    for (int round = 0; round < 50; ++round) {
      const double distance = dice.between(1, 25), gap = std::pow(10, dice.between(-10, -7));
      const Pose world = dice.pose(30);
      TestScene scene;
      const bool turned = round % 2 == 0;
      const ObjectId behind =
          scene.add_scenery(Shape::box({1, 60, 60}), world * Pose{{distance + 0.5 + gap, 0, 0}, Quat::Identity()});
      const ObjectId nearer =
          scene.add_robot({{Shape::box({2, 60, 60}), world * Pose{{distance + 1, 0, 0}, Quat::Identity()}}});
      SceneTable table;
      table.build(scene.index());
      std::vector<double> ranges(pattern.size());
      std::vector<ObjectId> found(pattern.size());
      const Viewpoint from{world * Pose{Vec3::Zero(), from_rpy(turned ? 0.7 : 0, 0, 0)}, 60};
      caster.cast(scan_kernels_for(isa), table, from, pattern, ranges, found);
      for (const ObjectId hit : found) EXPECT_EQ(hit, nearer) << "and not " << index_of(behind);
    }
}

TEST(LaserEdge, GivesTheSameBitsWithEveryInstructionSet) {
  Dice dice(23);
  RayCaster caster;
  std::vector<RayPattern> patterns;
  patterns.emplace_back(Grid{.min_angle = -2, .max_angle = 2, .columns = 170});
  patterns.emplace_back(
      Grid{.min_angle = -pi, .max_angle = pi, .columns = 90, .min_elevation = -0.5, .max_elevation = 0.4, .rows = 7});
  patterns.emplace_back(Grid{.min_angle = -2, .max_angle = 2, .columns = 10});
  for (int round = 0; round < 30; ++round) {
    TestScene scene;
    scene.add_scenery(Shape::plane(), {{0, 0, -1}, from_rpy(0.01, 0.02, 0)});
    for (int i = 0; i < 5 * round; ++i) scene.add_scenery(dice.shape(0.1, 2), dice.pose(12));
    for (int i = 0; i < round; ++i)
      scene.add_robot({{dice.shape(0.1, 0.5), dice.pose(8)}, {dice.shape(0.1, 0.5), dice.pose(8)}});
    SceneTable table;
    table.build(scene.index());
    const Viewpoint from{dice.pose(8), dice.between(4, 40),
                         round % 3 == 0 ? no_robot : RobotId(std::uint32_t(round % 3 - 1)), 0.02};
    for (const RayPattern& pattern : patterns) {
      std::vector<double> first, ranges(pattern.size());
      std::vector<ObjectId> first_hits, hits(pattern.size());
      for (const lane::Isa isa : instruction_sets()) {
        caster.cast(scan_kernels_for(isa), table, from, pattern, ranges, {});
        std::vector<double> without_hits = ranges;
        caster.cast(scan_kernels_for(isa), table, from, pattern, ranges, hits);
        EXPECT_EQ(std::memcmp(without_hits.data(), ranges.data(), ranges.size() * sizeof(double)), 0);
        if (first.empty()) first = ranges, first_hits = hits;
        EXPECT_EQ(std::memcmp(first.data(), ranges.data(), ranges.size() * sizeof(double)), 0);
        EXPECT_EQ(first_hits, hits);
      }
    }
  }
}

}  // namespace
}  // namespace muro::raycast
