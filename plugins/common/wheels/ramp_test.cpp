// SPDX-License-Identifier: MIT
#include "ramp.hpp"

#include <gtest/gtest.h>

namespace muro::wheeled {
namespace {

TEST(Ramp, ReachesItsTargetWithinTheStepAndStaysThere) {
  const Ramp r = ramp(1, 3, 4, 2);  // 0.5 s at 4 rad/s^2, then 1.5 s at 3 rad/s
  EXPECT_DOUBLE_EQ(r.end, 0.5);
  EXPECT_DOUBLE_EQ(r.at(0.25), 2);
  EXPECT_DOUBLE_EQ(r.at(0.5), 3);
  EXPECT_DOUBLE_EQ(r.last, 3);
  EXPECT_DOUBLE_EQ(r.acceleration_at(0.25), 4);
  EXPECT_DOUBLE_EQ(r.acceleration_at(0.5), 0);
  EXPECT_DOUBLE_EQ(r.angle(2), 1 + 4.5);
}

TEST(Ramp, GetsAsFarAsItsAccelerationAllows) {
  const Ramp r = ramp(1, -10, 4, 0.5);
  EXPECT_DOUBLE_EQ(r.last, -1);
  EXPECT_DOUBLE_EQ(r.end, 0.5);
  EXPECT_DOUBLE_EQ(r.angle(0.5), 0);
}

TEST(Ramp, JumpsWhenNothingLimitsIt) {
  const Ramp r = ramp(1, -10, unlimited, 0.5);
  EXPECT_EQ(r.at(0), -10);
  EXPECT_EQ(r.angle(0.5), -5);
}

TEST(Ramp, StepsOfHalfTheTimeCoverTheSameAngle) {
  for (double target = -5; target < 5; target += 0.37)
    for (const double most : {0.5, 3.0, 20.0, unlimited}) {
      const Ramp whole = ramp(0.7, target, most, 0.6), first = ramp(0.7, target, most, 0.3);
      const Ramp second = ramp(first.last, target, most, 0.3);
      EXPECT_NEAR(whole.angle(0.6), first.angle(0.3) + second.angle(0.3), 1e-14);
      EXPECT_NEAR(whole.last, second.last, 1e-14);
    }
}

}  // namespace
}  // namespace muro::wheeled
