// SPDX-License-Identifier: MIT
#include "target_interpolation.hpp"

#include <gtest/gtest.h>

namespace muro {
namespace {

TEST(TargetInterpolation, MakesARampOfAStaircaseOnePeriodLater) {
  double memory[TargetInterpolation::numbers] = {};
  const TargetInterpolation interpolation{memory};
  const double speed = 0.7, period = 0.01, step = 0.001;
  double target = 0;
  for (int k = 0; k < 200; ++k) {
    if (k % 10 == 0) target = speed * (0.001 * k);
    const Reference r = interpolation.advance(target, 0, period, step);
    if (k < 10) continue;  // the first target is the position of the joint
    ASSERT_NEAR(r.position, speed * (step * (k + 1) - period), 1e-12) << k;
    ASSERT_NEAR(r.velocity, speed, 1e-9) << k;
  }
}

TEST(TargetInterpolation, ArrivesAndStays) {
  double memory[TargetInterpolation::numbers] = {};
  const TargetInterpolation interpolation{memory};
  double largest = 0;
  for (int k = 0; k < 7; ++k) largest = std::max(largest, interpolation.advance(1, 0.2, 0.0055, 0.001).velocity);
  EXPECT_EQ(interpolation.advance(1, 0.2, 0.0055, 0.001).position, 1);
  EXPECT_EQ(interpolation.advance(1, 0.2, 0.0055, 0.001).velocity, 0);
  EXPECT_NEAR(largest, 0.8 / 0.0055, 1e-9) << "begins at the joint";
}

}  // namespace
}  // namespace muro
