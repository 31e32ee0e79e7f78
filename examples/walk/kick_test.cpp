// SPDX-License-Identifier: MIT
// Kicks against their purpose: the ways of soles and centre of mass alone; and how far a ball rolls and whether the
// robot stays on its feet when forces move both.
#include "kick.hpp"

#include <gtest/gtest.h>

#include "examples/common/repeat_testing.hpp"
#include "generated_humanoid_testing.hpp"
#include "walk_testing.hpp"

namespace muro::walk_test {
namespace {

using walking::left_side;
using walking::right_side;

constexpr double feet_apart = 0.09;  // m

walking::Kick kick_with(walking::Side foot, double speed, const walking::KickSettings& k) {
  walking::Reference from;
  from.soles = {{{{0, 0.5 * feet_apart, 0}, 0}, {{0, -0.5 * feet_apart, 0}, 0}}};
  walking::Kick kick;
  kick.begin(from, foot, speed, k);
  return kick;
}

TEST(Kick, SwingsItsSoleAsFastAsItIsToldAndPutsItBack) {
  const walking::KickSettings k;
  for (const walking::Side foot : {left_side, right_side}) {
    walking::Kick kick = kick_with(foot, 1.5, k);
    const double h = 1e-4;
    double fastest = 0, least = 0, most = 0, before = 0;
    for (int i = 0; i < 100000 && !kick.is_done(k); ++i) {
      kick.advance(h);
      const walking::SolePlace sole = kick.reference(k).soles[foot];
      fastest = std::max(fastest, (sole.at.x - before) / h);
      least = std::min(least, sole.at.x), most = std::max(most, sole.at.x);
      before = sole.at.x;
    }
    EXPECT_NEAR(fastest, 1.5, 1e-3);
    EXPECT_NEAR(least, -k.back, 1e-6);
    EXPECT_NEAR(most, k.forward, 1e-6);
    const walking::SolePlace end = kick.reference(k).soles[foot];
    EXPECT_NEAR(end.at.x, 0, 1e-12);
    EXPECT_NEAR(end.height, 0, 1e-12);
  }
}

/// Computes the pendulum's ZMP, x - x''/w^2, by differences of the places of the centre of mass.
TEST(Kick, KeepsItsZmpBelowTheFeet) {
  const walking::KickSettings k;
  const double h = 1e-3, w2 = 9.81 / k.com_height;
  walking::Kick kick = kick_with(left_side, 2, k);
  std::array<double, 3> y{};
  double farthest = 0, from_foot = 0;
  for (int i = 0; i < 100000 && !kick.is_done(k); ++i) {
    kick.advance(h);
    const walking::Reference now = kick.reference(k);
    y = {y[1], y[2], now.y.position};
    if (i < 2) continue;
    const double zmp = y[1] - (y[2] - 2 * y[1] + y[0]) / (h * h) / w2;
    farthest = std::max(farthest, std::abs(zmp));
    if (!now.both) from_foot = std::max(from_foot, std::abs(zmp + 0.5 * feet_apart + k.outward));
  }
  EXPECT_LT(farthest, 0.5 * feet_apart + 0.033) << "the outer edge of a sole";
  EXPECT_LT(from_foot, 1e-3) << "while one foot carries: where it is to be";
  EXPECT_NEAR(kick.reference(k).y.position, 0, 1e-12) << "the weight is on both feet again";
}

/// A robot that kicks at 3 s, and the ball of examples/soccer in front of a foot, from the middle of its toe.
struct Player {
  std::string motion = "articulated", imu = "mti1", kicks = "foot=1, speed=3, every=100";
  double ahead = 0.12, left = 0;  // m
};

constexpr double toe = 0.0555;  // m, ahead of where the trunk begins

std::vector<std::string> scene_of(const Player& p, const std::string& numbers = "forward=0") {
  const double side = p.kicks.find("foot=-1") == p.kicks.npos ? 1 : -1;
  const std::string at =
      "{x: " + std::to_string(toe + p.ahead) + ", y: " + std::to_string(side * 0.5 * feet_apart + p.left) + "}";
  const bool engine = p.motion == "mujoco" || p.motion == "bullet" || p.motion == "ode";
  return {"robots.walker.motion.use=motion." + p.motion, "robots.walker.imu_error.part=" + p.imu, tunables(numbers),
          "robots.walker.kicker={use: controller.library, library: kicker, rate: 25, tunables: [" + p.kicks + "]}",
          "robots.ball={shape: {sphere: 0.07}, mass: 0.205, friction: 0.5, restitution: 0.76, "
          "rolling_resistance: 0.005, motion: {use: motion." +
              (engine ? p.motion : "articulated") + ", rate: 1000}, at: " + at + "}"};
}

Vec3 ball_of(Walker& walker) {
  World& w = walker.world();
  return w.value(w.find_robot("ball")->base(), keys::pose).position;
}

/// Returns the way of the ball, m ahead and m to the left.
Vec3 way_of_ball(const Player& p) {
  Walker walker(scene_of(p));
  const Vec3 before = ball_of(walker);
  walker.run(2.96);
  EXPECT_EQ(walker.phase(), 1) << "it stands";
  walker.run(0.4);
  EXPECT_EQ(walker.phase(), 5) << "it kicks";
  walker.run(4.5);
  EXPECT_EQ(walker.phase(), 1) << "it stands again";
  EXPECT_GT(walker.upright(), 0.999);
  EXPECT_GT(walker.least_upright(), std::cos(0.15));
  EXPECT_EQ(walker.touched(), "");
  return ball_of(walker) - before;
}

void expect_a_kick(const Player& p, double metres = 1.5) {
  const Vec3 way = way_of_ball(p);
  EXPECT_GT(way.x(), metres) << p.motion << " " << p.kicks << " " << p.ahead << " " << p.left;
  EXPECT_LT(std::abs(way.y()), std::tan(15 * M_PI / 180) * way.x());
}

TEST(Kick, OfTheLeftFootRollsABallAway) { expect_a_kick({.kicks = "foot=1, speed=3, every=100"}); }
TEST(Kick, OfTheRightFootRollsABallAway) { expect_a_kick({.kicks = "foot=-1, speed=3, every=100"}); }
TEST(Kick, OfAFootThatNoForceMovesRollsABallAway) { expect_a_kick({.motion = "biped"}, 2.5); }

TEST(Kick, IsWeakerWhereLessIsAskedFor) {
  const double slow = way_of_ball({.kicks = "foot=1, speed=0.6, every=100"}).x();
  EXPECT_GT(slow, 0.1);
  EXPECT_LT(slow, 1);
}

TEST(Kick, InTheMiddleOfAWalkEndsTheWalkFirst) {
  Walker walker(scene_of({.kicks = "foot=1, speed=3, start=4, every=100", .ahead = 3}, "forward=0.1"));
  walker.run(3.96);
  EXPECT_EQ(walker.phase(), 2);
  walker.run(0.08);
  EXPECT_EQ(walker.phase(), 5);
  for (int i = 0; i < 20 && walker.phase() == 5; ++i) walker.run(0.2);
  EXPECT_EQ(walker.phase(), 2) << "and goes on afterwards";
  walker.run(2);
  EXPECT_GT(walker.least_upright(), std::cos(0.15));
}

TEST(Kick, GoesOnFromASnapshotToTheSameBits) {
  Walker walker(scene_of({}));
  example_test::expect_same_bits_from_snapshot(walker.simulation(), 3.8, 1);
}

TEST(Kick, SlowFromWhereverTheBallLiesBeforeTheFoot) {
  for (const char* kicks : {"foot=1, speed=3, every=100", "foot=-1, speed=3, every=100"})
    for (const double ahead : {0.1, 0.12, 0.14})
      for (const double left : {-0.02, 0.0, 0.02})
        expect_a_kick({.imu = "mpu6050", .kicks = kicks, .ahead = ahead, .left = left}, 1.3);
}

TEST(Kick, SlowAtOtherMotions) {
  for (const char* motion : {"mujoco", "bullet", "ode", "simplified"})
    for (const char* kicks : {"foot=1, speed=3, every=100", "foot=-1, speed=3, every=100"})
      expect_a_kick({.motion = motion, .imu = "mpu6050", .kicks = kicks}, motion == std::string("ode") ? 1.1 : 1.4);
}

/// Expects 20 kicks, after which the robot still stands in its place.
void expect_twenty(const std::string& motion, const std::string& imu, const std::string& foot) {
  SCOPED_TRACE(motion + " " + imu + " " + foot);
  Walker walker(scene_of({.motion = motion, .imu = imu, .kicks = foot + ", speed=3, every=3", .ahead = 5}));
  walker.run(3 + 20 * 3);
  EXPECT_GT(walker.least_upright(), std::cos(0.2));
  EXPECT_EQ(walker.touched(), "");
  EXPECT_LT(walker.pose().position.head<2>().norm(), 0.6);
}

TEST(Kick, SlowTwentyInARowWithoutAFall) {
  for (const char* motion : {"articulated", "biped"})
    for (const char* imu : {"mti1", "mpu6050"})
      for (const char* foot : {"foot=1", "foot=-1", "alternate=1"}) expect_twenty(motion, imu, foot);
  for (const char* motion : {"mujoco", "bullet", "simplified"}) expect_twenty(motion, "mpu6050", "alternate=1");
}

/// A robot with OP2's lengths and masses, by its numbers alone.
TEST(Kick, SlowOfOneLikeOp2) {
  for (const char* motion : {"motion.articulated", "motion.mujoco"}) {
    SCOPED_TRACE(motion);
    const test::ScratchFolder folder;
    const std::string file = scenario_of(folder, op2(), motion, "forward=0");
    const Numbers n = op2();
    const double x = n.sole_x + 0.5 * n.foot[0] + 0.12;
    Walker walker({"robots.walker.kicker={use: controller.library, library: kicker, rate: 25, "
                   "tunables: [speed=3, every=3]}",
                   "robots.ball={shape: {sphere: 0.07}, mass: 0.205, friction: 0.5, restitution: 0.76, "
                   "rolling_resistance: 0.005, motion: {use: " +
                       std::string(motion) + ", rate: 1000}, at: {x: " + std::to_string(x) +
                       ", y: " + std::to_string(n.hip_y + n.sole_y) + "}}"},
                  file);
    const Vec3 before = ball_of(walker);
    walker.run(63);
    const Vec3 way = ball_of(walker) - before;
    EXPECT_GT(way.x(), 1);
    EXPECT_LT(std::abs(way.y()), std::tan(15 * M_PI / 180) * way.x());
    EXPECT_GT(walker.least_upright(), std::cos(0.2)) << "in 20 kicks";
  }
}

}  // namespace
}  // namespace muro::walk_test
