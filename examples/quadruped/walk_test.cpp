// SPDX-License-Identifier: MIT
// The robots of the example follow commands, on their feet alone, in every full dynamics.
#include <gtest/gtest.h>

#include "quadruped_testing.hpp"
#include "tests/support/files.hpp"

namespace muro::quadruped_test {
namespace {

std::string with(const std::string& motion) { return "robots.walker.motion.use=motion." + motion; }

/// Checks a robot that has trotted for `seconds` over the planks, which are 1 cm high.
void expect_a_trot(Walk& walk, double seconds, const Vec3& start) {
  const Vec3 way = walk.pose().position - start;
  EXPECT_NEAR(way.x(), 0.5 * seconds, 0.04 * seconds);
  EXPECT_LT(std::abs(way.y()), 0.03 * seconds + 0.05);
  EXPECT_GT(walk.seen.lowest, 0.31);
  EXPECT_LT(walk.seen.highest, 0.345);
  EXPECT_LT(walk.seen.most_tilt, 8 * degree);
  EXPECT_EQ(walk.seen.touched, "") << "only feet touch";
}

TEST(Trot, GoesOverPlanksInEveryFullDynamics) {
  for (const std::string motion : {"articulated", "bullet", "mujoco", "ode"}) {
    SCOPED_TRACE(motion);
    Walk walk(scenario, Walk::alone({with(motion), "robots.walker.place={list: [{x: 0.5}]}"}));
    walk.run(1.2);
    walk.forget();
    const Vec3 start = walk.pose().position;
    walk.run(1.8);
    expect_a_trot(walk, 1.8, start);
    EXPECT_GT(walk.pose().position.x(), 1.4) << "m: over three planks";
  }
}

TEST(Trot, Slow10MetresOverPlanksInEveryFullDynamics) {
  for (const std::string motion : {"articulated", "bullet", "mujoco", "ode"}) {
    SCOPED_TRACE(motion);
    Walk walk(scenario, Walk::alone({with(motion)}));
    walk.run(1.5);
    walk.forget();
    const Vec3 start = walk.pose().position;
    walk.run(21);
    expect_a_trot(walk, 21, start);
    EXPECT_GT(walk.pose().position.x(), 10);
  }
}

TEST(Trot, BearsTheNoiseOfFiveDevices) {
  for (int seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    Walk walk(scenario, Walk::alone({"seed=" + std::to_string(seed)}));
    walk.run(1.5);
    walk.forget();
    const Vec3 start = walk.pose().position;
    walk.run(4);
    expect_a_trot(walk, 4, start);
    EXPECT_LT(walk.seen.off, 0.15) << "m/s, of its estimate";
  }
}

TEST(Trot, SlowBearsTheNoiseOfFiveDevicesFor10Metres) {
  for (const std::string motion : {"articulated", "bullet", "mujoco", "ode"}) {
    for (int seed = 11; seed <= 15; ++seed) {
      SCOPED_TRACE(motion + std::to_string(seed));
      Walk walk(scenario, Walk::alone({with(motion), "seed=" + std::to_string(seed)}));
      walk.run(1.5);
      walk.forget();
      const Vec3 start = walk.pose().position;
      walk.run(21);
      expect_a_trot(walk, 21, start);
    }
  }
}

TEST(Trot, TwoFeetAtATimeCarryIt) {
  Walk walk(scenario, Walk::alone());
  walk.run(0.18);
  EXPECT_NEAR(walk.feet_down(0.1)[4], 1, 1e-9) << "it has stood up on four";
  walk.run(1.7);
  const std::vector<double> down = walk.feet_down(2);
  EXPECT_GT(down[2], 0.7);
  EXPECT_LT(down[0], 0.05);
  EXPECT_LT(down[4], 0.2);
}

TEST(Trot, WithoutFeetThatFeelItGoesByTheClock) {
  const test::ScratchFolder folder;
  std::string text = test::text_of(scenario);
  const auto from = text.find("               \"foot.contact=front_left"), to = text.find("outputs", from);
  text.replace(from, to - from, "               ]\n      ");
  for (std::size_t at = 0; (at = text.find("../models", at)) != text.npos;)
    text.replace(at, 9, MURO_TEST_SOURCE_DIR "/examples/models");
  std::vector<std::string> overrides = Walk::alone();
  for (const std::string foot : {"front_left", "front_right", "rear_left", "rear_right"})
    overrides.push_back("robots.walker." + foot + "=off");
  Walk walk(folder.file("blind.yaml", text), overrides);
  walk.run(1.5);
  walk.forget();
  const Vec3 start = walk.pose().position;
  walk.run(4);
  expect_a_trot(walk, 4, start);
}

TEST(Trot, FollowsATourForwardsAsideTurningAndStands) {
  Walk walk(scenario, {"robots.mates=off", "robots.walker=off"}, "a1");
  walk.run(2);  // from 1 s on: 0.5 m/s forwards
  walk.forget();
  Vec3 before = walk.pose().position;
  walk.run(3);
  EXPECT_NEAR(walk.pose().position.x() - before.x(), 1.5, 0.1);
  walk.run(1);  // 0.3 m/s to the left
  before = walk.pose().position;
  walk.run(3);
  EXPECT_NEAR(walk.pose().position.y() - before.y(), 0.9, 0.1);
  EXPECT_LT(std::abs(walk.pose().position.x() - before.x()), 0.1);
  walk.run(0.5);  // 0.7 rad/s to the left
  double yaw = walk.yaw();
  walk.run(3);
  EXPECT_NEAR(std::remainder(walk.yaw() - yaw - 2.1, 2 * M_PI), 0, 0.1);
  walk.run(2);  // from 13 s on: nothing
  before = walk.pose().position;
  yaw = walk.yaw();
  EXPECT_NEAR(walk.feet_down(1.5)[4], 1, 1e-9) << "it stands on all of them";
  EXPECT_LT((walk.pose().position - before).norm(), 0.005);
  EXPECT_NEAR(walk.yaw(), yaw, 0.005);
  walk.run(2.5);  // from 17 s on: an arc of 0.6 m/s and 0.5 rad/s
  before = walk.pose().position;
  walk.run(2 * M_PI / 0.5 / 4);
  EXPECT_NEAR((walk.pose().position - before).norm(), std::sqrt(2) * 0.6 / 0.5, 0.15) << "the chord of a quarter";
  walk.run(2.5);
  EXPECT_LT(walk.velocity().norm(), 0.02);
  EXPECT_LT(walk.seen.most_tilt, 6 * degree);
  EXPECT_GT(walk.seen.lowest, 0.31);
  EXPECT_LT(walk.seen.highest, 0.34);
  EXPECT_EQ(walk.seen.touched, "");
}

TEST(Trot, PairsAtTheSimplifiedLevelKeepUpWithFullDynamics) {
  Walk walk(scenario, {"robots.a1=off"});
  const auto mate = [&] { return walk.world().value("mates_0/base_link", keys::pose); };
  walk.run(1.5);
  const double x = mate().position.x(), x_full = walk.pose().position.x();
  for (int i = 0; i < 8; ++i) {
    walk.run(0.5);
    EXPECT_NEAR(mate().position.z(), 0.32, 0.02);
    EXPECT_GT((mate().orientation * Vec3::UnitZ()).z(), std::cos(5 * degree));
  }
  EXPECT_NEAR(mate().position.x() - x, walk.pose().position.x() - x_full, 0.15 * 2);
}

/// Returns a ramp up and a ramp down, 3 m each, from 1 m on: boxes whose tops meet.
std::string ramps(double slope) {
  const double c = std::cos(slope), s = std::sin(slope);
  const auto box = [&](const char* name, double x, double z, double pitch) {
    return std::string(name) + ": {shape: {box: [3, 3, 0.2]}, friction: 0.9, at: {x: " + std::to_string(x) +
           ", z: " + std::to_string(z) + ", pitch: " + std::to_string(pitch) + "}}";
  };
  return "world.objects={ground: {shape: plane, friction: 0.9}, " +
         box("up", 1 + 1.5 * c + 0.1 * s, 1.5 * s - 0.1 * c, -slope) + ", " +
         box("down", 1 + 4.5 * c - 0.1 * s, 1.5 * s - 0.1 * c, slope) + "}";
}

TEST(Trot, ClimbsARampOf8DegreesAndComesDown) {
  Walk walk(scenario, Walk::alone({ramps(8 * degree)}));
  walk.run(9);
  EXPECT_GT(walk.seen.highest, 0.32 + 3 * std::sin(8 * degree) - 0.08) << "m: astride the top";
  walk.run(7);
  EXPECT_GT(walk.pose().position.x(), 7.3);
  EXPECT_NEAR(walk.pose().position.z(), 0.325, 0.01);
  EXPECT_LT(walk.seen.most_tilt, 6 * degree);
  EXPECT_EQ(walk.seen.touched, "");
}

TEST(Trot, GoesOnWhereItsLevelOfDetailChangesInMidStride) {
  Walk walk(scenario,
            {"robots.a1=off", "robots.walker=off",
             "robots.mates.motion={levels: {far: {use: motion.simplified, joints: effort}, "
             "near: {use: motion.articulated, joints: effort}, engine: {use: motion.bullet, joints: effort}}, "
             "start: far, dwell: 0.5, rules: [near at 1.63, far at 2.58, engine at 3.47]}"},
            "mates_0");
  walk.run(1.5);
  walk.forget();
  const Vec3 start = walk.pose().position;
  walk.run(3);
  EXPECT_NEAR(walk.pose().position.x() - start.x(), 1.5, 0.2);
  EXPECT_GT(walk.seen.lowest, 0.3);
  EXPECT_LT(walk.seen.highest, 0.34);
  EXPECT_LT(walk.seen.most_tilt, 6 * degree);
}

}  // namespace
}  // namespace muro::quadruped_test
