// SPDX-License-Identifier: MIT
// The robot finds out from the angles alone whether servos give way.
#include "springs.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace walking {
namespace {

constexpr double h = 0.008;  // s
constexpr LegAngles loaded{0, 0.02, -0.01, 0.05, -0.03, 0.02};

BothLegs times(double share) {
  BothLegs all{loaded, loaded};
  for (LegAngles& leg : all)
    for (double& angle : leg) angle *= share;
  return all;
}

/// Returns a stand on the left foot.
Reference one_leg() {
  Reference now;
  now.both = 0;
  return now;
}

TEST(Springs, StayAsTheyAreWhileJointsSwingAboutWhatTheyCarry) {
  Springs springs;
  for (int k = 0; k < 2000; ++k) {
    // as measured at 0.25 m/s by forces: 0.2 to 1.7 of the sag, in a step of 0.36 s
    springs.feel(times(1), times(0.95 + 0.75 * std::sin(2 * M_PI * k * h / 0.36)), one_leg(), h);
    ASSERT_EQ(springs.share(), 1) << k;
  }
}

TEST(Springs, AreNoneSoonAfterJointsMeetTheirTargets) {
  Springs springs;
  for (int k = 0; k < 100; ++k) springs.feel(times(1), times(0.8), one_leg(), h);
  BothLegs behind{};
  behind[right_side][knee] = 0.2;        // it swings, faster than the joint can follow
  behind[left_side][ankle_pitch] = 0.1;  // feedback turns it
  springs.feel(times(1), behind, one_leg(), h);
  EXPECT_EQ(springs.share(), 1) << "once may be chance";
  for (int k = 0; k < 2; ++k) springs.feel(times(1), behind, one_leg(), h);
  EXPECT_EQ(springs.share(), 0) << "after 24 ms";
}

TEST(Springs, ComeBackSmoothlyWhenJointsGiveWay) {
  Springs springs;
  for (int k = 0; k < 10; ++k) springs.feel(times(1), times(0), one_leg(), h);
  double largest_jump = 0;
  for (int k = 0; k < 125; ++k) {
    const double before = springs.share();
    springs.feel(times(1), times(0.8), one_leg(), h);
    largest_jump = std::max(largest_jump, std::abs(springs.share() - before));
  }
  EXPECT_NEAR(springs.share(), 1, 1e-3) << "after a second";
  EXPECT_LT(largest_jump, 0.1);
}

TEST(Springs, WithoutStiffnessTellNothing) {
  Springs springs;
  for (int k = 0; k < 100; ++k) {
    springs.feel_at_rest({}, times(0), h);
    springs.feel({}, times(0), one_leg(), h);
  }
  EXPECT_EQ(springs.share(), 1);
}

TEST(Springs, AtRestHalfOfTheSagCountsAsAll) {
  Springs stiff, soft;
  for (int k = 0; k < 125; ++k) {
    stiff.feel_at_rest(times(1), times(0.4), h);
    soft.feel_at_rest(times(1), times(0.6), h);
  }
  EXPECT_LT(stiff.share(), 1e-3);
  EXPECT_EQ(soft.share(), 1);
}

}  // namespace
}  // namespace walking
