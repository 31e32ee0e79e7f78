// SPDX-License-Identifier: MIT
#include <array>
#include <cstring>

#include "lanes/ground.hpp"
#include "pairs_testing.hpp"

namespace muro::native {
namespace {

using testing::Randoms;

/// Eight robots of one body with one shape, on a plane.
struct Eight {
  static constexpr int most = 8, stride = sizeof(Contact) / sizeof(double);

  KernelShape shape;
  GroundPlane ground;
  Pose poses[8];
  std::array<double, most * stride> contacts[8] = {};
  double signatures[8];

  explicit Eight(const KernelShape& of) : shape(of) { std::fill_n(signatures, 8, -1.0); }

  void touch(const GroundKernels& kernels, int first, int count) {
    GroundBatch batch;
    batch.shapes = &shape;
    batch.shape_count = 1;
    batch.planes = &ground;
    batch.plane_count = 1;
    batch.contact_stride = stride;
    batch.used = count;
    for (int i = 0; i < count; ++i) {
      batch.poses[i].base = poses[first + i].position.data();
      batch.contacts[i] = contacts[first + i].data();
      batch.signatures[i] = &signatures[first + i];
    }
    kernels.find_contacts(batch);
  }
};

/// Rounding differs in one of hundreds of results where a compiler contracts a product and a sum, hence so many.
TEST(GroundKernel, ALaneGivesTheBitsOfEachRobotAlone) {
  Randoms random(5);
  const lane::Isa best = lane::best_isa();
  for (int k = 0; k < 6000; ++k) {
    Shape shape = random.shape(ShapeKind(random.below(4)));
    const double off = random.below(2);
    shape.origin.position = off * 0.1 * random.direction();
    if (random.below(2) == 1) shape.origin.orientation = random.rotation();
    Eight together(kernel_shape_of(shape));
    together.ground.is_level = random.below(4) > 0;
    if (!together.ground.is_level) Vec3::Map(together.ground.normal) = random.direction();
    for (Pose& p : together.poses) {
      p.position = {random.uniform(-30, 30), random.uniform(-30, 30), random.uniform(-0.5, 0.5)};
      if (!together.ground.is_level) p.position *= 0.02;
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

}  // namespace
}  // namespace muro::native
