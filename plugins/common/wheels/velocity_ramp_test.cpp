// SPDX-License-Identifier: MIT
#include "velocity_ramp.hpp"

#include <gtest/gtest.h>

namespace muro::wheels {
namespace {

TEST(VelocityRamp, ReachesItsTargetWithinTheStepAndStaysThere) {
  const VelocityRamp r = velocity_ramp(1, 3, 4, 2);  // 0.5 s at 4 rad/s^2, then 1.5 s at 3 rad/s
  EXPECT_DOUBLE_EQ(r.end, 0.5);
  EXPECT_DOUBLE_EQ(r.velocity_at(0.25), 2);
  EXPECT_DOUBLE_EQ(r.velocity_at(0.5), 3);
  EXPECT_DOUBLE_EQ(r.final, 3);
  EXPECT_DOUBLE_EQ(r.acceleration_at(0.25), 4);
  EXPECT_DOUBLE_EQ(r.acceleration_at(0.5), 0);
  EXPECT_DOUBLE_EQ(r.angle(2), 1 + 4.5);
}

TEST(VelocityRamp, GetsAsFarAsItsAccelerationAllows) {
  const VelocityRamp r = velocity_ramp(1, -10, 4, 0.5);
  EXPECT_DOUBLE_EQ(r.final, -1);
  EXPECT_DOUBLE_EQ(r.end, 0.5);
  EXPECT_DOUBLE_EQ(r.angle(0.5), 0);
}

TEST(VelocityRamp, JumpsWhenNothingLimitsIt) {
  const VelocityRamp r = velocity_ramp(1, -10, unlimited, 0.5);
  EXPECT_EQ(r.velocity_at(0), -10);
  EXPECT_EQ(r.angle(0.5), -5);
}

TEST(VelocityRamp, StepsOfHalfTheTimeCoverTheSameAngle) {
  for (double target = -5; target < 5; target += 0.37)
    for (const double acceleration : {0.5, 3.0, 20.0, unlimited}) {
      const VelocityRamp once = velocity_ramp(0.7, target, acceleration, 0.6),
                         first = velocity_ramp(0.7, target, acceleration, 0.3);
      const VelocityRamp second = velocity_ramp(first.final, target, acceleration, 0.3);
      EXPECT_NEAR(once.angle(0.6), first.angle(0.3) + second.angle(0.3), 1e-14);
      EXPECT_NEAR(once.final, second.final, 1e-14);
    }
}

}  // namespace
}  // namespace muro::wheels
