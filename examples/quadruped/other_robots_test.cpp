// SPDX-License-Identifier: MIT
// Other robots trot by the same library with other numbers.
#include <gtest/gtest.h>

#include "generated_robot_testing.hpp"
#include "quadruped_testing.hpp"
#include "tests/support/complaint.hpp"

namespace muro::quadruped_test {
namespace {

/// Trots for so many seconds with 0.5 m/s from 1 s on, and is pushed by an impulse (N s) of half its mass to the left.
void trots(const Numbers& n, const std::string& motion, double seconds, const std::string& world = "") {
  SCOPED_TRACE(motion);
  const test::ScratchFolder folder;
  Walk walk(GeneratedRobot(n).write(folder, motion, "forward: 0.5", world), {});
  walk.run(1.5);
  walk.forget();
  const Vec3 start = walk.pose().position;
  walk.run(seconds);
  const Vec3 way = walk.pose().position - start;
  const double height = n.foot_radius + 0.75 * (n.thigh + n.shank) - n.hip_up;
  EXPECT_NEAR(way.x(), 0.5 * seconds, 0.05 * seconds);
  EXPECT_LT(std::abs(way.y()), 0.03 * seconds);
  EXPECT_NEAR(walk.seen.lowest, height, 0.015);
  EXPECT_NEAR(walk.seen.highest, height, 0.025);
  EXPECT_LT(walk.seen.most_tilt, 6 * degree);
  EXPECT_EQ(walk.seen.touched, "");
  walk.push({0, 5 * n.mass(), 0});
  walk.run(0.1);
  walk.push({0, 0, 0});
  walk.run(1.5);
  EXPECT_LT(walk.seen.most_tilt, 12 * degree);
  EXPECT_LT(std::abs(walk.velocity().y()), 0.15);
  EXPECT_GT(walk.seen.lowest, 0.9 * height);
}

TEST(OtherRobots, OneOfMiniCheetahsClassTrots) { trots(mini_cheetah(), "articulated", 3); }
TEST(OtherRobots, ALargeOneWithKneesToEachOtherTrots) { trots(large(), "articulated", 3); }

TEST(OtherRobots, SlowTheyTrotInEveryFullDynamics) {
  for (const std::string motion : {"articulated", "bullet", "ode", "mujoco"})
    for (const Numbers& n : {mini_cheetah(), large()}) trots(n, motion, 10);
}

TEST(OtherRobots, NumbersThatCannotBeAreComplainedOf) {
  const auto what = [](const std::string& setting) {
    try {
      Walk walk(scenario, Walk::alone({"robots.walker.trot." + setting}));
      walk.run(0.01);
    } catch (const std::exception& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_SAYS(what("arguments=[legs=FL FR RL RL]"), "FL, FR, RL and RR, each once");
  EXPECT_SAYS(what("arguments=[signs=1 1 2]"), "12 numbers");
  EXPECT_SAYS(what("arguments=[signs=1 1 1 1 1 1 1 1 1 1 1 0]"), "12 times 1 or -1");
  EXPECT_SAYS(what("arguments=[offsets=1 1 1 1 1 1 1 1 1 1 1 x]"), "12 numbers");
  EXPECT_SAYS(what("tunables=[height=0.5]"), "legs are too short");
}

}  // namespace
}  // namespace muro::quadruped_test
