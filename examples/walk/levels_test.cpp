// SPDX-License-Identifier: MIT
// A walking humanoid goes on when another motion takes it over, in any phase of a step.
#include <gtest/gtest.h>

#include "walk_testing.hpp"

namespace muro::walk_test {
namespace {

constexpr double period = 0.36;  // s, of a step

/// Returns a motion with two levels: 0 by forces, 1 by kinematics.
std::string levels(const std::string& by_forces, const std::string& start) {
  return "robots.walker.motion={levels: {forces: {use: motion." + by_forces +
         ", rate: 1000, joints: position, interpolate: 0.008, stiffness: 24.9, damping: 0.68}, "
         "biped: {use: motion.biped, rate: 1000, interpolate: 0.008, feet: [l_foot_link, r_foot_link]}}, start: " +
         start + "}";
}

/// Hands it over after a while of walking, at `part` of two steps (left and right), and expects it to walk on for 10 s.
void expect_to_walk_on(const std::string& by_forces, bool to_biped, double part, double speed = 0.1,
                       double largest_tilt = 0.16) {
  SCOPED_TRACE(by_forces + (to_biped ? " to biped, " : " from biped, ") + std::to_string(part));
  Walker walker({levels(by_forces, to_biped ? "forces" : "biped"), tunables("forward=" + std::to_string(speed))});
  walker.run(6 + 2 * period * part);
  walker.world().value("walker/base_link", keys::motion_level_target) = to_biped ? 1 : 0;
  walker.run(1);
  const Vec3 before = walker.pose().position;
  walker.run(9);
  const Vec3 way = walker.pose().position - before;
  const double planned = 9 * speed;
  EXPECT_GT(way.x(), (to_biped ? 0.95 : 0.85) * planned) << "by forces steps come out shorter or longer";
  EXPECT_LT(way.x(), (to_biped ? 1.05 : 1.35) * planned);
  EXPECT_LT(std::abs(way.y()), 0.1);
  EXPECT_EQ(walker.phase(), 2) << "it walks";
  EXPECT_NEAR(walker.pose().position.z(), 0.2555, 0.004);
  EXPECT_GT(walker.least_upright(), std::cos(largest_tilt)) << "rad, at once after the change";
  EXPECT_GT(walker.least_height(), 0.245);
}

TEST(Levels, FromForcesToKinematicsItWalksOn) {
  for (const double part : {0.0, 0.23, 0.46, 0.68, 0.91}) expect_to_walk_on("articulated", true, part);
}

TEST(Levels, FromKinematicsToForcesItWalksOn) {
  for (const double part : {0.1, 0.4, 0.7}) expect_to_walk_on("articulated", false, part);
}

TEST(Levels, SlowTwentyPhasesOfAStep) {
  for (const char* motion : {"articulated", "mujoco", "bullet", "simplified"})
    for (int k = 0; k < 20; ++k)
      for (const bool to_biped : {true, false}) expect_to_walk_on(motion, to_biped, 0.05 * k);
}

TEST(Levels, SlowTwentyPhasesOfAFasterStep) {
  for (int k = 0; k < 20; ++k) expect_to_walk_on("articulated", true, 0.05 * k, 0.2, 0.3);
}

/// A robot that is handed over while it lies or gets up is put on its feet. It walks when getting up has ended.
TEST(Levels, OneThatGetsUpWalksAfterIt) {
  for (const double time : {0.5, 2.0, 5.0}) {
    SCOPED_TRACE(time);
    Walker walker({levels("articulated", "forces"), "robots.walker.at={pitch: -1.57}"});
    walker.run(time);
    EXPECT_GE(walker.phase(), 3) << "it falls or gets up";
    walker.world().value("walker/base_link", keys::motion_level_target) = 1;
    walker.run(14 - time);
    EXPECT_EQ(walker.phase(), 2);
    const Vec3 before = walker.pose().position;
    walker.run(4);
    EXPECT_NEAR((walker.pose().position - before).norm(), 0.4, 0.05);
    EXPECT_NEAR(walker.pose().position.z(), 0.2555, 0.004);
  }
}

/// Hands it over there and back each second.
TEST(Levels, HandedOverAgainAndAgainItWalksOn) {
  Walker walker({levels("articulated", "forces")});
  walker.run(6);
  for (int k = 0; k < 10; ++k) {
    walker.world().value("walker/base_link", keys::motion_level_target) = (k + 1) % 2;
    walker.run(1.048);
  }
  EXPECT_GT(walker.pose().position.x(), 0.3 + 0.9);
  EXPECT_EQ(walker.phase(), 2);
  EXPECT_GT(walker.least_upright(), std::cos(0.16));
}

}  // namespace
}  // namespace muro::walk_test
