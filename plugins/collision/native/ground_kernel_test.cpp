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

  Solid solid;
  Ground ground;
  Pose poses[8];
  std::array<double, most * stride> contacts[8] = {};
  double signatures[8];

  explicit Eight(const Solid& of) : solid(of) { std::fill_n(signatures, 8, -1.0); }

  void touch(const GroundKernels& kernels, int first, int count) {
    GroundWork work;
    work.solids = &solid;
    work.solid_count = 1;
    work.planes = &ground;
    work.plane_count = 1;
    work.contact_stride = stride;
    work.used = count;
    for (int i = 0; i < count; ++i) {
      work.poses[i].base = poses[first + i].position.data();
      work.contacts[i] = contacts[first + i].data();
      work.signatures[i] = &signatures[first + i];
    }
    kernels.touch(work);
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
    Eight together(solid_of(shape));
    together.ground.level = random.below(4) > 0;
    if (!together.ground.level) Vec3::Map(together.ground.normal) = random.direction();
    for (Pose& p : together.poses) {
      p.position = {random.uniform(-30, 30), random.uniform(-30, 30), random.uniform(-0.5, 0.5)};
      if (!together.ground.level) p.position *= 0.02;
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
