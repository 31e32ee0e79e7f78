// SPDX-License-Identifier: MIT
#include <array>
#include <cstring>

#include "hulls/hull_plane.hpp"
#include "lanes/ground.hpp"
#include "pairs_testing.hpp"

namespace muro::native {
namespace {

using testing::Randoms;

/// Eight robots of one body each, with the same shape, on a plane.
struct Eight {
  static constexpr int most = 8, words = 3, stride = sizeof(Contact) / sizeof(double);

  KernelShape shape;
  Ground ground;
  Pose poses[8];
  std::array<double, most * stride> contacts[8] = {};
  std::array<double, words> signatures[8];
  std::uint8_t left[1] = {};  ///< by slot

  explicit Eight(const KernelShape& of) : shape(of) {
    for (auto& s : signatures) s.fill(-1);
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
      batch.poses[i].base = poses[first + i].position.data();
      batch.contacts[i] = contacts[first + i].data();
      batch.signatures[i] = signatures[first + i].data();
    }
    return kernels.find_contacts(batch);
  }
};

/// Rounding differs in one of hundreds of results if a compiler contracts a product and a sum. So many are needed.
TEST(GroundKernel, ALaneGivesTheBitsOfEachRobotAlone) {
  Randoms random(5);
  const lane::Isa best = lane::best_isa();
  for (int k = 0; k < 6000; ++k) {
    Shape shape = random.shape(ShapeKind(random.below(4)));
    const double off = random.below(2);
    shape.origin.position = off * 0.1 * random.direction();
    if (random.below(2) == 1) shape.origin.orientation = random.rotation();
    Eight together(kernel_shape_of(shape));
    together.ground.plane.is_level = random.below(4) > 0;
    if (!together.ground.plane.is_level) Vec3::Map(together.ground.plane.normal) = random.direction();
    for (Pose& p : together.poses) {
      p.position = {random.uniform(-30, 30), random.uniform(-30, 30), random.uniform(-0.5, 0.5)};
      if (!together.ground.plane.is_level) p.position *= 0.02;
      p.orientation = random.rotation();
    }
    Eight alone = together, base = together;
    together.touch(ground_kernels_for(best), 0, 8);
    base.touch(ground_kernels_for(lane::Isa::base), 0, 8);
    for (int i = 0; i < 8; ++i) {
      alone.touch(ground_kernels_for(best), i, 1);
      ASSERT_EQ(together.signatures[i], alone.signatures[i]);
      ASSERT_EQ(together.signatures[i], base.signatures[i]);
      ASSERT_EQ(together.contacts[i], alone.contacts[i]) << "shape " << int(shape.kind) << ", robot " << i;
      ASSERT_EQ(together.contacts[i], base.contacts[i]) << "shape " << int(shape.kind) << ", robot " << i;
    }
  }
}

TEST(GroundKernel, GivesVerticesOfHullsAsPairsDoAndTellsWhereTheyAreTooMany) {
  Randoms random(6);
  const lane::Isa best = lane::best_isa();
  int touching = 0, too_many = 0;
  for (int k = 0; k < 2000; ++k) {
    std::vector<Vec3> vertices;
    const int count = 4 + random.below(90);
    for (int i = 0; i < count; ++i) vertices.push_back(Vec3(0.5, 0.3, 0.2).cwiseProduct(random.direction()));
    KernelShape hull = kernel_shape_of(Shape::box({1, 0.6, 0.4}));
    hull.kind = KernelShapeKind::mesh;
    hull.vertices = vertices.data()->data();
    hull.vertex_count = count;
    ASSERT_LE(words_of(&hull, 1, 1), Eight::words);
    Eight together(hull);
    together.ground.plane.is_level = random.below(4) > 0;
    if (!together.ground.plane.is_level) Vec3::Map(together.ground.plane.normal) = random.direction();
    TransformedShape plane = transformed(Shape::plane(), {});
    plane.axes.col(2) = Vec3::Map(together.ground.plane.normal);
    for (Pose& p : together.poses) {
      p.orientation = random.rotation();
      p.position = plane.axes.col(2) * random.uniform(0.05, 0.4);
    }
    Eight base = together;
    const unsigned bits = together.touch(ground_kernels_for(best), 0, 8);
    EXPECT_EQ(bits, base.touch(ground_kernels_for(lane::Isa::base), 0, 8));
    for (int i = 0; i < 8; ++i) {
      Eight alone(hull);
      alone.ground = together.ground;
      alone.poses[i] = together.poses[i];
      const unsigned own = alone.touch(ground_kernels_for(best), i, 1);
      ASSERT_EQ(together.signatures[i], alone.signatures[i]);
      ASSERT_EQ(together.contacts[i], alone.contacts[i]);
      ASSERT_EQ(together.contacts[i], base.contacts[i]);
      ASSERT_EQ(own >> 8, bits >> (8 + i) & 1);
      int below = 0;
      for (const Vec3& v : vertices) below += plane.axis().dot(together.poses[i] * v) < 0;
      std::vector<ContactPoint> points;
      add_hull_on_plane(hull, together.poses[i], plane, points);
      EXPECT_EQ(points.size(), std::min(std::size_t(8), std::size_t(below)));
      too_many += below > 8;
      touching += below > 0;
      EXPECT_EQ(own >> 8, below > 8 ? 1u : 0u);
      for (std::size_t n = 0; below <= 8 && n < points.size(); ++n) {
        const double* const contact = together.contacts[i].data() + n * Eight::stride;
        EXPECT_EQ(points[n].point, Vec3::Map(contact));
        EXPECT_EQ(points[n].depth, contact[depth_number]);
      }
    }
  }
  EXPECT_GT(touching, 4000);
  EXPECT_GT(too_many, 1000);
}

}  // namespace
}  // namespace muro::native
