// SPDX-License-Identifier: MIT
// Robots of other lengths, masses, servos and joints walk by other numbers alone.
#include <gtest/gtest.h>

#include "generated_humanoid_testing.hpp"
#include "walk_testing.hpp"

namespace muro::walk_test {
namespace {

/// Walks for some seconds and looks how far, after 3 s in which it gets ready and the first steps are taken.
void expect_walk(const Numbers& n, const std::string& motion, const std::string& tunables, double speed) {
  SCOPED_TRACE(motion);
  const test::ScratchFolder folder;
  Walker walker({}, scenario_of(folder, n, motion, tunables));
  walker.run(3.5);
  const Vec3 before = walker.pose().position;
  walker.run(5);
  const Vec3 way = walker.pose().position - before;
  EXPECT_NEAR(way.x(), 5 * speed, 0.3 * 5 * speed);
  EXPECT_LT(std::abs(way.y()), 0.1);
  EXPECT_GT(walker.least_upright(), 0.99);
  EXPECT_GT(walker.least_height(), 0.95 * before.z());
  EXPECT_EQ(walker.touched(), "");
  EXPECT_GT(walker.feet_down()[1], 250) << "feet leave the ground";
}

TEST(OtherRobots, OneLikeOp2WithMirroredJointsWalks) {
  for (const char* motion : {"motion.articulated", "motion.mujoco"}) expect_walk(op2(), motion, "forward=0.1", 0.1);
}

TEST(OtherRobots, OneLikeSigmabanWithOtherZerosWalks) {
  for (const char* motion : {"motion.articulated", "motion.mujoco"})
    expect_walk(sigmaban(), motion,
                "forward=0.15, period=0.4, rise=0.03, step_forward=0.12, "
                "ankle_pitch_rate=0.03, ankle_roll_rate=0.03",
                0.15);
}

}  // namespace
}  // namespace muro::walk_test
