// SPDX-License-Identifier: MIT
#include "constant_twist.hpp"
#include "muro/toolkit/rotations.hpp"

#include <gtest/gtest.h>

namespace muro::constant_twist {
namespace {

TEST(AConstantTwist, GivesTheArcBetweenTwoPoses) {
  const Vec3 u(0.3, -0.1, 0.2), w(0.2, -0.4, 0.9);  // in the axes of the body, for the whole way
  const Pose a{{1, 2, 3}, from_rpy(0.3, -0.2, 2)};
  const auto at = [&](double t) {
    const Vec3 v = t * w;
    return a * Pose{screw_integral(v) * Vec3(t * u), rotation_of(v)};
  };
  for (const double t : {0.0, 0.1, 0.5, 0.9, 1.0}) {
    const Pose p = interpolated(a, at(1), t), expected = at(t);
    EXPECT_NEAR((p.position - expected.position).norm(), 0, 1e-14);
    EXPECT_NEAR(p.orientation.angularDistance(expected.orientation), 0, 1e-7);
  }
}

TEST(AConstantTwist, GivesTheMiddleWithoutRotation) {
  const Pose a{{1, 2, 3}, from_rpy(0.3, -0.2, 2)}, b{{2, 2, 3}, a.orientation};
  EXPECT_NEAR((interpolated(a, b, 0.5).position - Vec3(1.5, 2, 3)).norm(), 0, 1e-15);
}

TEST(AConstantTwist, TakesABodyAroundACircle) {
  const Pose start{{0, -2, 0}, Quat::Identity()};
  const Pose p = advanced(start, {0, 0, M_PI / 2}, {2 * M_PI / 2, 0, 0});
  EXPECT_NEAR((p.position - Vec3(2, 0, 0)).norm(), 0, 1e-14);
}

}  // namespace
}  // namespace muro::constant_twist
