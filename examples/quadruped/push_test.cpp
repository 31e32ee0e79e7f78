// SPDX-License-Identifier: MIT
// A trotting robot is pushed from eight directions and goes on.
#include <gtest/gtest.h>

#include "quadruped_testing.hpp"

namespace muro::quadruped_test {
namespace {

void push_for_a_tenth(Walk& walk, const Vec3& force) {
  walk.push(force);
  walk.run(0.1);
  walk.push({0, 0, 0});
}

/// Pushes the base of a robot of 12 kg that trots with 0.4 m/s, at the time `when` for 0.1 s along `angle`.
void pushes(const std::string& motion, double angle, double when, double force, double least_height = 0.3,
            double most_tilt = 10 * degree, double settles = 1) {
  SCOPED_TRACE(motion + ", " + std::to_string(std::lround(angle / degree)) + " deg, " + std::to_string(when) + " s");
  Walk walk(scenario,
            Walk::alone({"robots.walker.motion.use=motion." + motion, "robots.walker.trot.tunables=[forward=0.4]"}));
  walk.run(when);
  const Vec3 before = walk.pose().position, speed = walk.velocity();
  walk.forget();
  const Vec3 along{std::cos(angle), std::sin(angle), 0};
  push_for_a_tenth(walk, force * along);
  EXPECT_GT((walk.velocity() - speed).dot(along), 0.2 * 0.1 * force / 12) << "it has felt the push";
  walk.run(settles);
  const Vec3 recovered = walk.pose().position;
  walk.run(0.6);
  EXPECT_GT(walk.seen.lowest, least_height);
  EXPECT_LT(walk.seen.highest, 0.36);
  EXPECT_LT(walk.seen.most_tilt, most_tilt);
  EXPECT_EQ(walk.seen.touched, "");
  const Vec3 way = walk.pose().position - recovered;
  EXPECT_NEAR(way.x() / 0.6, 0.4, 0.08) << "m/s: it goes on";
  EXPECT_LT(std::abs(way.y()) / 0.6, 0.1);
  EXPECT_LT(std::abs(walk.pose().position.y() - before.y()), 0.6);
  EXPECT_LT(std::abs(walk.yaw()), 10 * degree);
}

TEST(Push, From8DirectionsIsBorneInEveryFullDynamics) {
  const std::string motions[] = {"articulated", "bullet", "ode", "mujoco"};
  for (int direction = 0; direction < 8; ++direction) pushes(motions[direction % 4], direction * 45 * degree, 1.2, 60);
}

TEST(Push, SlowFrom8DirectionsInBothHalvesOfTheStride) {
  for (const std::string motion : {"articulated", "bullet", "ode", "mujoco", "simplified"})
    for (int direction = 0; direction < 8; ++direction)
      for (int part = 0; part < 2; ++part) pushes(motion, direction * 45 * degree, 1.55 + 0.1 * part, 60);
}

TEST(Push, SlowOfTwiceTheImpulseIsBorneByStepsAside) {
  for (int direction = 0; direction < 8; ++direction)
    for (int part = 0; part < 4; ++part)
      pushes("articulated", direction * 45 * degree, 2 + 0.1 * part, 120, 0.28, 25 * degree, 2);
}

TEST(Push, AStandingRobotStepsAndStandsAgain) {
  Walk walk(scenario, Walk::alone({"robots.walker.trot.tunables=[forward=0]"}));
  walk.run(1.5);
  EXPECT_NEAR(walk.feet_down(0.2)[4], 1, 1e-9) << "all feet stand";
  push_for_a_tenth(walk, {0, 90, 0});
  EXPECT_GT(walk.feet_down(0.3)[2], 0.5) << "it steps";
  walk.run(2.4);
  EXPECT_NEAR(walk.feet_down(0.2)[4], 1, 1e-9);
  EXPECT_LT(walk.velocity().norm(), 0.02);
  EXPECT_LT(walk.seen.most_tilt, 10 * degree);
}

/// Returns the place of the base 1 s after a push, with `rate` steps a second.
Vec3 place_after_push(const std::string& motion, int rate, double angle) {
  Walk walk(scenario,
            Walk::alone({"robots.walker.motion.use=motion." + motion, "robots.walker.trot.tunables=[forward=0.4]",
                         "robots.walker.motion.rate=" + std::to_string(rate)}));
  walk.run(1.2);
  push_for_a_tenth(walk, 60 * Vec3(std::cos(angle), std::sin(angle), 0));
  walk.run(0.9);
  return walk.pose().position;
}

void expect_the_same_way_with_small_steps(const std::string& motion, double most) {
  for (int direction = 0; direction < 8; ++direction) {
    SCOPED_TRACE(motion + ", " + std::to_string(45 * direction) + " deg");
    const double angle = direction * 45 * degree;
    const Vec3 apart = place_after_push(motion, 1000, angle) - place_after_push(motion, 8000, angle);
    EXPECT_LT(apart.norm(), most) << "m";
  }
}

TEST(Push, At1kHzLeadsToWhereItDoesAt8kHz) { expect_the_same_way_with_small_steps("articulated", 0.01); }
TEST(Push, SlowAt1kHzLeadsToWhereItDoesAt8kHzInEngines) {
  for (const char* motion : {"mujoco", "bullet"}) expect_the_same_way_with_small_steps(motion, 0.01);
}

}  // namespace
}  // namespace muro::quadruped_test
