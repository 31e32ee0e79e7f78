// SPDX-License-Identifier: MIT
#include "omni_jacobian.hpp"

#include <gtest/gtest.h>

#include "tests/support/randoms.hpp"

namespace muro::wheels {
namespace {

TEST(OmniJacobian, FollowsTheEquationOfTheSwedishWheel) {
  test::Randoms draw(4);
  for (int round = 0; round < 50; ++round) {
    const double l = draw.uniform(0.1, 2), alpha = draw.uniform(-3, 3), beta = draw.uniform(-3, 3),
                 gamma = draw.uniform(-1.2, 1.2), r = draw.uniform(0.02, 0.3);
    OmniWheel w;
    w.centre = {l * std::cos(alpha), l * std::sin(alpha), draw.uniform(-1, 1)};
    w.axis = {std::cos(alpha + beta), std::sin(alpha + beta), 0};
    w.heading = w.axis.cross(Vec3::UnitZ());
    w.radius = r, w.roller_angle = gamma;
    const PlanarTwist row = inverse_jacobian_row(w);
    const double k = 1 / (r * std::cos(gamma));
    EXPECT_NEAR(row.x, k * std::sin(alpha + beta + gamma), 1e-12);
    EXPECT_NEAR(row.y, -k * std::cos(alpha + beta + gamma), 1e-12);
    EXPECT_NEAR(row.yaw_rate, -k * l * std::cos(beta + gamma), 1e-12);
  }
}

TEST(OmniJacobian, IsTheInverseOfItsRows) {
  test::Randoms draw(5);
  for (std::size_t count = 3; count < 8; ++count) {
    std::vector<OmniWheel> wheels(count);
    for (OmniWheel& w : wheels) {
      const double yaw = draw.uniform(-3, 3);
      w.centre = {draw.uniform(-1, 1), draw.uniform(-1, 1), 0}, w.radius = draw.uniform(0.05, 0.1),
      w.roller_angle = draw.uniform(-1, 1);
      w.heading = {std::cos(yaw), std::sin(yaw), 0};
    }
    const std::vector<PlanarTwist> columns = jacobian_columns(RobotView{}, wheels);
    const PlanarTwist v{draw.uniform(-1, 1), draw.uniform(-1, 1), draw.uniform(-1, 1)};
    PlanarTwist sum;
    for (std::size_t i = 0; i < count; ++i) {
      const PlanarTwist a = inverse_jacobian_row(wheels[i]);
      sum = sum + columns[i] * (a.x * v.x + a.y * v.y + a.yaw_rate * v.yaw_rate);
    }
    EXPECT_NEAR(sum.x, v.x, 1e-12);
    EXPECT_NEAR(sum.y, v.y, 1e-12);
    EXPECT_NEAR(sum.yaw_rate, v.yaw_rate, 1e-12);
  }
}

}  // namespace
}  // namespace muro::wheels
