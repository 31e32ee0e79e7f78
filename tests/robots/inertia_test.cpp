// SPDX-License-Identifier: MIT
// Inertias in files that are impossible for a body.
#include <gtest/gtest.h>

#include "muro/toolkit/rotations.hpp"
#include "plugins/motion/common/multibody/consistent_inertia.hpp"
#include "tests/robots/trial.hpp"
#include "tests/support/bodies.hpp"

namespace muro::robots {
namespace {

TEST(ConsistentInertia, OfATensorWithOneLargeMomentIsThatOfAFlatBody) {
  const Quat turn = from_rpy(0.3, -1.1, 2);
  const Inertia long_one = Inertia{.mass = 2, .com = {1, 2, 3}, .ixx = 1, .iyy = 0.1, .izz = 0.3};
  const auto nearest = nearest_consistent_inertia(long_one.in({Vec3::Zero(), turn}));
  ASSERT_TRUE(nearest.has_value());
  const Inertia straight = nearest->in({Vec3::Zero(), turn.conjugate()});
  EXPECT_LT((straight.tensor() - Vec3(1, 0.4, 0.6).asDiagonal().toDenseMatrix()).norm(), 1e-12);
  EXPECT_EQ(straight.mass, 2);
  EXPECT_LT((straight.com - Vec3(1, 2, 3)).norm(), 1e-12);
}

TEST(ConsistentInertia, IsLeftAsItIs) {
  EXPECT_FALSE(nearest_consistent_inertia({.mass = 1, .ixx = 1, .iyy = 1, .izz = 1}));
  EXPECT_FALSE(nearest_consistent_inertia({.mass = 1, .ixx = 1, .iyy = 0.4, .izz = 0.6})) << "a plate";
  EXPECT_FALSE(nearest_consistent_inertia({.mass = 1, .ixx = 1, .iyy = 0.4, .izz = 0.5995})) << "a plate, rounded";
  EXPECT_FALSE(nearest_consistent_inertia({.mass = 1})) << "a point";
  EXPECT_FALSE(nearest_consistent_inertia({.mass = 1, .ixx = std::nan("")}));
}

class EveryMotion : public ::testing::TestWithParam<std::string> {};

TEST_P(EveryMotion, TurnsABodyOfImpossibleInertiaAsAFlatOne) {
  test::Scene s;
  s.world().set(world_object, keys::gravity, Vec3(0, 0, 0));
  const RobotView& r =
      s.add("top", test::single_body(Shape::sphere(0.1), {.mass = 1, .ixx = 1, .iyy = 0.001, .izz = 0.001}), {},
            {Vec3::Zero(), {1, 1, 1}});
  s.use(GetParam(), 1000, s.all_robots());
  s.use_contacts();
  s.build();
  // (1, 0.5, 0.5) kg m^2 and an energy of 1 J: no spin is faster than 2 rad/s. With 0.001 it would be 31 rad/s.
  for (int i = 0; i < 50; ++i) {
    s.run_for(0.1);
    ASSERT_LT(s.twist(r).angular.norm(), 2.05) << 0.1 * i << " s";
  }
}

INSTANTIATE_TEST_SUITE_P(Inertias, EveryMotion, ::testing::ValuesIn(motions()),
                         [](const auto& test) { return test.param.substr(test.param.find('.') + 1); });

}  // namespace
}  // namespace muro::robots
