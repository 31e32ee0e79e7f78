// SPDX-License-Identifier: MIT
// Other robots trot by the same library with other numbers.
#include <gtest/gtest.h>

#include <random>

#include "generated_robot_testing.hpp"
#include "quadruped_testing.hpp"
#include "tests/support/complaint.hpp"

namespace muro::quadruped_test {
namespace {

/// Checks a robot that trots with `speed` (m/s) for `seconds`, and is then pushed to the left by an impulse (N s) of
/// half its mass.
void expect_a_trot(Walk& walk, double speed, double seconds, double height, double mass) {
  walk.run(1.5);
  walk.forget();
  const Vec3 start = walk.pose().position;
  walk.run(seconds);
  const Vec3 way = walk.pose().position - start;
  EXPECT_NEAR(way.x(), speed * seconds, 0.1 * speed * seconds);
  EXPECT_LT(std::abs(way.y()), 0.03 * seconds);
  EXPECT_NEAR(walk.seen.lowest, height, 0.04 * height);
  EXPECT_NEAR(walk.seen.highest, height, 0.06 * height);
  EXPECT_LT(walk.seen.most_tilt, 4 * degree);
  EXPECT_EQ(walk.seen.touched, "");
  walk.push({0, 5 * mass, 0});
  walk.run(0.1);
  walk.push({0, 0, 0});
  EXPECT_GT(walk.velocity().y(), 0.1) << "it has felt the push";
  walk.run(1.5);
  EXPECT_LT(walk.seen.most_tilt, 12 * degree);
  EXPECT_LT(std::abs(walk.velocity().y()), 0.15);
  EXPECT_GT(walk.seen.lowest, 0.9 * height);
  EXPECT_EQ(walk.seen.touched, "");
}

void trots(const Numbers& n, const std::string& motion, double speed, double seconds, const std::string& more = "") {
  SCOPED_TRACE(motion + ", " + std::to_string(n.mass()) + " kg");
  const test::ScratchFolder folder;
  const std::string tunables = "forward: " + std::to_string(speed) + (more.empty() ? "" : ", " + more);
  Walk walk(GeneratedRobot(n).write(folder, motion, tunables), {});
  expect_a_trot(walk, speed, seconds, n.foot_radius + 0.75 * (n.thigh + n.shank) - n.hip_up, n.mass());
}
void trots_as_a1(const std::string& motion, double seconds) {
  SCOPED_TRACE(motion);
  Walk walk(scenario,
            {"robots.mates=off", "robots.walker=off", "robots.a1.tour=off", "robots.a1.trot.tunables.forward=0.5",
             "robots.a1.at.y=0", "robots.a1.at.x=-0.2", "robots.a1.motion.use=motion." + motion},
            "a1");
  expect_a_trot(walk, 0.5, seconds, 0.32, 12.776);
}
const std::string for_small = "lift: 0.03, press: 0.005, period: 0.3";

TEST(OtherRobots, OneOfA1sClassTrotsOverPlanks) { trots_as_a1("articulated", 3); }
TEST(OtherRobots, OneOfMiniCheetahsClassTrots) { trots(mini_cheetah(), "articulated", 0.5, 3); }
TEST(OtherRobots, ALargeOneWithKneesToEachOtherTrots) { trots(large(), "articulated", 0.5, 3); }
TEST(OtherRobots, ASmallOneTrots) { trots(small(), "articulated", 0.2, 3, for_small); }

TEST(OtherRobots, SlowTheyTrotInEveryFullDynamics) {
  for (const std::string motion : {"articulated", "bullet", "ode", "mujoco"}) {
    trots_as_a1(motion, 21);
    for (const Numbers& n : {mini_cheetah(), large()}) trots(n, motion, 0.5, 10);
    trots(small(), motion, 0.2, 10, for_small);
  }
}

/// Returns a robot like A1 and Mini Cheetah and beyond: lengths off by up to a quarter, masses by more, random joints.
Numbers random_robot(unsigned seed) {
  std::mt19937 random(seed);
  const auto in = [&](double low, double high) { return std::uniform_real_distribution(low, high)(random); };
  Numbers n = mini_cheetah();
  n.hip_front = in(0.15, 0.25), n.hip_rear = -in(0.15, 0.25), n.hip_side = in(0.04, 0.08), n.hip_up = in(-0.02, 0.02);
  n.abduction = in(0.04, 0.1), n.thigh = in(0.16, 0.26), n.shank = n.thigh * in(0.9, 1.1),
  n.foot_radius = in(0.015, 0.03);
  n.trunk = in(3, 9), n.hip_mass = in(0.3, 0.7), n.thigh_mass = in(0.4, 0.9), n.shank_mass = in(0.05, 0.2);
  n.foot_mass = in(0.01, 0.06), n.armature = in(0, 0.006), n.friction = in(0, 0.3);
  n.trunk_size = {in(0.3, 0.5), in(0.1, 0.2), in(0.08, 0.14)};
  const double effort = 1.2 * n.mass() * 9.81 * (n.thigh + n.shank) / 4;  // several times the effort of standing
  n.effort = {effort, effort, effort}, n.speed = in(12, 30);
  n.bend_front = in(0, 1) < 0.7 ? -1 : 1, n.bend_rear = in(0, 1) < 0.7 ? -1 : 1;
  n.mirrored = in(0, 1) < 0.5, n.hip_zero = in(-0.5, 0.5), n.knee_zero = in(-0.5, 0.5);
  return n;
}

TEST(OtherRobots, RandomOnesTrot) {
  for (unsigned seed = 1; seed <= 4; ++seed) {
    SCOPED_TRACE(seed);
    trots(random_robot(seed), "articulated", 0.4, 2);
  }
}

TEST(OtherRobots, SlowRandomOnesTrotInEveryFullDynamics) {
  const std::string motions[] = {"articulated", "bullet", "mujoco", "ode"};
  for (unsigned seed = 1; seed <= 40; ++seed) {
    SCOPED_TRACE(seed);
    trots(random_robot(seed), motions[seed % 4], 0.4, 5);
  }
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
