// SPDX-License-Identifier: MIT
// Heightmaps in every collision algorithm: a slope compared with its plane, ridges, and points of hills.
#include <cstring>
#include <random>

#include "muro/toolkit/heightmap.hpp"
#include "muro/toolkit/rotations.hpp"
#include "tests/conformance/collision/touching.hpp"
#include "tests/support/files.hpp"

namespace muro {
namespace {

using test::CollisionScene;

struct EveryCollisionOnHeightmaps : ::testing::TestWithParam<std::string> {
  test::ScratchFolder folder;
  std::vector<float> values;
  Heightmap map;

  template <class Height>
  void make(std::uint32_t columns, std::uint32_t rows, double x, double y, Height height) {
    values.resize(std::size_t(columns) * rows);
    map = {values, columns, rows, {x, y, 1}};
    for (std::uint32_t r = 0; r < rows; ++r)
      for (std::uint32_t c = 0; c < columns; ++c) {
        const Vec3 p = map.node(c, r);
        values[r * columns + c] = float(height(p.x(), p.y()));
      }
  }
  /// Returns the contacts of a robot of one shape at `pose`.
  std::vector<Contact> contacts_of(const Shape& shape, const Pose& pose, const Pose& at = {}) const {
    const std::int32_t counts[] = {std::int32_t(map.rows), std::int32_t(map.columns)};
    std::string bytes(sizeof counts + sizeof(float) * values.size(), '\0');
    std::memcpy(bytes.data(), counts, sizeof counts);
    std::memcpy(bytes.data() + sizeof counts, values.data(), sizeof(float) * values.size());
    CollisionScene scene(GetParam());
    Shape hills{.kind = ShapeKind::heightmap, .size = map.size};
    hills.mesh = scene.world().intern(folder.file("hills.bin", bytes));
    scene.add_scenery("hills", hills, at);
    const RobotView& r = scene.add_dynamic("robot", shape, pose);
    scene.finish_setup();
    scene.step_once();
    return scene.contacts(r);
  }
};

const Shape some_shapes[] = {Shape::box({0.5, 0.4, 0.3}), Shape::sphere(0.2), Shape::cylinder(0.2, 0.5),
                             Shape::capsule(0.15, 0.4)};

TEST_P(EveryCollisionOnHeightmaps, ASlopeTouchesAsThePlaneThatItIs) {
  make(31, 21, 6, 4, [](double x, double y) { return 0.3 + 0.4 * x - 0.25 * y; });
  const Pose at{{2, 1, -0.5}, from_rpy(0, 0, 0.7)};
  const Vec3 normal = Vec3(-0.4, 0.25, 1).normalized();
  const Pose plane = at * Pose{{0, 0, 0.3}, Quat::FromTwoVectors(Vec3::UnitZ(), normal)};
  std::mt19937 random(4);
  std::uniform_real_distribution<double> place(-1, 1);
  for (const Shape& shape : some_shapes)
    for (int i = 0; i < 6; ++i) {
      const double x = place(random), y = place(random), roll = 3 * place(random), pitch = 3 * place(random);
      Pose pose = plane * Pose{{x, y, 0}, i == 0 ? from_rpy(0, 0, 0) : from_rpy(roll, pitch, 0)};
      // move the shape to the height at which its depth in the plane is one centimetre
      const std::vector<Contact> first = test::contacts_of(GetParam(), shape, pose, Shape::plane(), plane);
      ASSERT_FALSE(first.empty());
      pose.position += (test::deepest(first).depth - 0.01) * (at.orientation * normal);
      const Contact on_plane = test::deepest(test::contacts_of(GetParam(), shape, pose, Shape::plane(), plane));
      const std::vector<Contact> found = contacts_of(shape, pose, at);
      ASSERT_FALSE(found.empty()) << int(shape.kind) << " " << i;
      EXPECT_NEAR(test::deepest(found).depth, on_plane.depth, 1e-6) << int(shape.kind) << " " << i;
      for (const Contact& c : found)
        EXPECT_LT((c.normal - on_plane.normal).norm(), 1e-5) << int(shape.kind) << " " << i << test::text_of(found);
    }
}

TEST_P(EveryCollisionOnHeightmaps, ARidgeCarriesABoxAndABall) {
  make(3, 3, 4, 4, [](double x, double) { return 1 - std::abs(x); });
  for (const double gap : {-0.01, 0.01}) {
    const std::vector<Contact> box =
        contacts_of(Shape::box({0.5, 0.6, 0.2}), {{0.02, 0.13, 1.1 + gap}, Quat::Identity()});
    const std::vector<Contact> ball = contacts_of(Shape::sphere(0.2), {{0, 0.31, 1.2 + gap}, Quat::Identity()});
    if (gap > 0) {
      EXPECT_TRUE(box.empty()) << test::text_of(box);
      EXPECT_TRUE(ball.empty()) << test::text_of(ball);
      continue;
    }
    for (const auto* found : {&box, &ball}) {
      ASSERT_FALSE(found->empty());
      EXPECT_NEAR(test::deepest(*found).depth, 0.01, 1e-6) << test::text_of(*found);
      EXPECT_LT((test::deepest(*found).normal - Vec3::UnitZ()).norm(), 1e-6) << test::text_of(*found);
    }
  }
}

TEST_P(EveryCollisionOnHeightmaps, ShapesTouchHillsWherePointsOfTheHillsAreInThem) {
  std::mt19937 random(6);
  std::uniform_real_distribution<double> height(0, 0.3), place(-1.5, 1.5), above(0.1, 0.5);
  make(21, 21, 4, 4, [&](double, double) { return height(random); });
  int overlaps = 0, apart = 0;
  for (const Shape& shape : some_shapes)
    for (int i = 0; i < 12; ++i) {
      const double x = place(random), y = place(random), z = above(random), roll = 2 * place(random),
                   pitch = 2 * place(random);
      const Pose pose{{x, y, z}, from_rpy(roll, pitch, 0)}, back = pose.inverse();
      const auto is_inside = [&](const Vec3& p, double by) {
        const double off = p.head<2>().norm(), half = 0.5 * shape.size.z();
        if (shape.kind == ShapeKind::box) return (p.cwiseAbs().array() < 0.5 * shape.size.array() - by).all();
        if (shape.kind == ShapeKind::sphere) return p.norm() < shape.size.x() - by;
        if (shape.kind == ShapeKind::cylinder) return off < shape.size.x() - by && std::abs(p.z()) < half - by;
        return Vec3(off, 0, std::max(0.0, std::abs(p.z()) - half)).norm() < shape.size.x() - by;
      };
      bool inside = false, near = false;
      for (double u = -0.45; u <= 0.45; u += 0.01)
        for (double v = -0.45; v <= 0.45; v += 0.01) {
          const Vec3 p = back * Vec3(x + u, y + v, map.ground_at(x + u, y + v)->height);
          inside = inside || is_inside(p, 0.005);
          near = near || is_inside(p, -0.015);
        }
      const std::vector<Contact> found = contacts_of(shape, pose);
      if (inside) {
        ++overlaps;
        EXPECT_FALSE(found.empty()) << int(shape.kind) << " " << i;
      }
      if (!near && z > 0.3) {
        ++apart;
        EXPECT_TRUE(found.empty()) << int(shape.kind) << " " << i << test::text_of(found);
      }
    }
  EXPECT_GT(overlaps, 5);
  EXPECT_GT(apart, 5);
}

INSTANTIATE_TEST_SUITE_P(Conformance, EveryCollisionOnHeightmaps, ::testing::ValuesIn(test::algorithms_of("collision")),
                         test::name_of);
GTEST_ALLOW_UNINSTANTIATED_PARAMETERIZED_TEST(EveryCollisionOnHeightmaps);

}  // namespace
}  // namespace muro
