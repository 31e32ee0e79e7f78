// SPDX-License-Identifier: MIT
#include "sweep.hpp"

#include <gtest/gtest.h>

#include <numbers>

namespace muro::scanner {
namespace {

using std::numbers::pi;

TEST(ASweep, TakesEveryColumnOnceWhenTheMirrorPointsThere) {
  // the URG-04LX: 1024 steps of the mirror in a turn of 100 ms, 682 of them read
  const Grid urg{.min_angle = 0, .max_angle = 681 * 2 * pi / 1024, .columns = 682};
  for (const std::uint32_t steps : {2u, 7u, 100u, 5000u}) {
    const Sweep sweep(urg, false, steps);
    ASSERT_EQ(sweep.steps(), steps);
    std::uint32_t column = 0;
    for (std::uint32_t k = 0; k < steps; ++k) {
      EXPECT_EQ(sweep.first(k), column);
      for (; column < sweep.first(k + 1); ++column)
        EXPECT_NEAR((k + sweep.moment(column)) / steps, column / 1024.0, 1e-12) << "in turns";
    }
    EXPECT_EQ(column, 682u);
    EXPECT_EQ(sweep.last_step(), std::uint32_t(681.0 / 1024 * steps));
  }
}

TEST(ASweep, SpreadsTheRaysOfAListOverTheScan) {
  const Sweep sweep({.columns = 8}, true, 4);
  for (std::uint32_t k = 0; k < 4; ++k) EXPECT_EQ(sweep.first(k), 2 * k);
  EXPECT_EQ(sweep.moment(0), 0);
  EXPECT_EQ(sweep.moment(1), 0.5);
}

TEST(ThePoseBetween, FollowsTheArcOfAConstantTwist) {
  const Vec3 u(0.3, -0.1, 0.2), w(0.2, -0.4, 0.9);  // in the axes of the body, for the whole way
  const Pose a{{1, 2, 3}, from_rpy(0.3, -0.2, 2)};
  const auto at = [&](double t) {
    const Vec3 v = t * w;
    return a * Pose{screw_integral(v) * Vec3(t * u), rotation_of(v)};
  };
  for (const double t : {0.0, 0.1, 0.5, 0.9, 1.0}) {
    const Pose p = between(a, at(1), t), expected = at(t);
    EXPECT_NEAR((p.position - expected.position).norm(), 0, 1e-14);
    EXPECT_NEAR(p.orientation.angularDistance(expected.orientation), 0, 1e-7);
  }
}

TEST(ThePoseBetween, IsHalfWayWithoutATurn) {
  const Pose a{{1, 2, 3}, from_rpy(0.3, -0.2, 2)}, b{{2, 2, 3}, a.orientation};
  EXPECT_NEAR((between(a, b, 0.5).position - Vec3(1.5, 2, 3)).norm(), 0, 1e-15);
}

}  // namespace
}  // namespace muro::scanner
