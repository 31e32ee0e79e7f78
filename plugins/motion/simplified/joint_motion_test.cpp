// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "joint_motion.hpp"

namespace muro::simplified {
namespace {

constexpr double joint_step = 0.001;
using JointState = joints::JointState<double>;

TEST(JointMotion, ReachesAPositionInTheTimeOfATrapezoid) {
  // Bang-bang with a speed limit: t = d / v + v / a (textbook trapezoidal profile).
  const JointRange range{.speed = 2, .acceleration = 10};
  JointState joint{};
  double t = 0;
  while (joint.position != 3 && t < 10) {
    follow_position(joint, 3, range, joint_step);
    t += joint_step;
  }
  EXPECT_NEAR(t, 3.0 / 2 + 2.0 / 10, 2 * joint_step);
  EXPECT_NEAR(joint.velocity, 0, 1e-9);
}

TEST(JointMotion, NeverOvershootsNorExceedsItsLimitsOnTheWayToAPosition) {
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0, 1);
  for (int trial = 0; trial < 300; ++trial) {
    const double h = std::pow(10, -1 - 3 * unit(random));
    const JointRange range{.speed = 0.1 + 5 * unit(random), .acceleration = std::pow(10, -1 + 4 * unit(random))};
    const double goal = 4 * unit(random) - 2;
    JointState joint{4 * unit(random) - 2, 0};
    const double sign = goal < joint.position ? -1 : 1;
    for (int k = 0; k < 2000000 && joint.position != goal; ++k) {
      const JointState before = joint;
      follow_position(joint, goal, range, h);
      ASSERT_GE(sign * (goal - joint.position), 0) << trial;
      ASSERT_GE(sign * (joint.position - before.position), 0) << trial;
      ASSERT_LE(std::abs(joint.velocity), range.speed * (1 + 1e-12));
      ASSERT_LE(std::abs(joint.position - before.position), range.speed * h + 1e-14);
      ASSERT_LE(std::abs(joint.velocity - before.velocity), range.acceleration * h * (1 + 1e-5));
    }
    EXPECT_EQ(joint.position, goal) << trial;
    EXPECT_LE(std::abs(joint.velocity), 1e-3 * range.acceleration * h);
    follow_position(joint, goal, range, h);
    EXPECT_EQ(joint.position, goal);  // and stays
    EXPECT_EQ(joint.velocity, 0);
  }
}

TEST(JointMotion, TurnsBackForATargetBehindIt) {
  const JointRange range{.speed = 3, .acceleration = 20};
  JointState joint{0, 3};
  double farthest = 0;
  for (int k = 0; k < 2000; ++k) {
    follow_position(joint, 0, range, joint_step);
    farthest = std::max(farthest, joint.position);
  }
  EXPECT_NEAR(farthest, 3.0 * 3.0 / (2 * 20), 0.004);  // v^2 / (2 a): the shortest way to stop
  EXPECT_EQ(joint.position, 0);
}

TEST(JointMotion, TakesOnAVelocityAtTheGreatestAcceleration) {
  const JointRange range{.speed = 5, .acceleration = 10};
  JointState joint{};
  for (int k = 0; k < 400; ++k) follow_velocity(joint, 100, range, joint_step);
  EXPECT_NEAR(joint.velocity, 4, 1e-12);
  EXPECT_NEAR(joint.position, 0.5 * 10 * 0.4 * 0.4, 1e-12);
  for (int k = 0; k < 400; ++k) follow_velocity(joint, 100, range, joint_step);
  EXPECT_NEAR(joint.velocity, 5, 1e-12);
}

TEST(JointMotion, StopsAtALimitWhateverTheTarget) {
  for (const double a : {10.0, 100.0, 1e9})
    for (const bool by_acceleration : {false, true}) {
      const JointRange range{.lower = -0.5, .upper = 1, .speed = 5, .acceleration = a};
      JointState joint{};
      for (int k = 0; k < 3000; ++k) {
        by_acceleration ? follow_acceleration(joint, 8, range, joint_step)
                        : follow_velocity(joint, 4, range, joint_step);
        ASSERT_LE(joint.position, 1);
      }
      EXPECT_NEAR(joint.position, 1, 1e-9);
      EXPECT_NEAR(joint.velocity, 0, 1e-6);
      for (int k = 0; k < 5000; ++k) {
        by_acceleration ? follow_acceleration(joint, -8, range, joint_step)
                        : follow_velocity(joint, -4, range, joint_step);
        ASSERT_GE(joint.position, -0.5);
      }
      EXPECT_NEAR(joint.position, -0.5, 1e-9);
    }
}

TEST(JointMotion, FollowsAnAccelerationExactly) {
  const JointRange range{.acceleration = 50};
  JointState joint{0.25, -1};
  for (int k = 0; k < 1000; ++k) follow_acceleration(joint, 3, range, joint_step);
  EXPECT_NEAR(joint.velocity, 2, 1e-12);
  EXPECT_NEAR(joint.position, 0.25 - 1 + 1.5, 1e-12);
}

}  // namespace
}  // namespace muro::simplified
