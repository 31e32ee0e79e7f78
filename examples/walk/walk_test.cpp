// SPDX-License-Identifier: MIT
// The humanoid follows commands, on its soles alone, by kinematics and in every full dynamics.
#include <gtest/gtest.h>

#include "walk_testing.hpp"

namespace muro::walk_test {
namespace {

std::vector<std::string> with(const std::string& motion, const std::string& numbers = "forward=0.1", int seed = 1) {
  return {"robots.walker.motion.use=motion." + motion, tunables(numbers), "seed=" + std::to_string(seed)};
}

/// Expects it upright and at its height, with nothing but its soles on the ground.
void expect_upright(const Walker& walker) {
  EXPECT_GT(walker.least_upright(), std::cos(0.12));
  EXPECT_GT(walker.least_height(), 0.24) << "m: it stands at 0.255";
  EXPECT_EQ(walker.touched(), "");
}

/// Walks for 6 s; 2.4 s of these pass before the first step.
void expect_a_walk(const std::string& motion) {
  Walker walker(with(motion));
  walker.run(6);
  EXPECT_NEAR(walker.pose().position.x(), 0.1 * 3.4, 0.12);
  EXPECT_LT(std::abs(walker.pose().position.y()), 0.1);
  expect_upright(walker);
  if (motion == "biped") return;
  EXPECT_GT(walker.feet_down()[1], 150) << "feet leave the ground";
  EXPECT_LT(walker.feet_down()[0], 15) << "and one stays on it";
}

TEST(Walk, GoesForwardAtBiped) { expect_a_walk("biped"); }
TEST(Walk, GoesForwardAtArticulated) { expect_a_walk("articulated"); }
TEST(Walk, GoesForwardAtMujoco) { expect_a_walk("mujoco"); }
TEST(Walk, GoesForwardAtBullet) { expect_a_walk("bullet"); }

/// Equal numbers at every level: the robot finds out by its joints whether servos give way.
TEST(Walk, GoesThreeMetresAtEachLevelByTheSameNumbers) {
  for (const char* motion : {"biped", "simplified", "articulated"}) {
    SCOPED_TRACE(motion);
    Walker walker(with(motion));
    walker.run(36);
    EXPECT_GT(walker.pose().position.x(), 3);
    EXPECT_LT(std::abs(walker.pose().position.y()), 0.2);
    EXPECT_GT(walker.least_upright(), std::cos(0.12));
    EXPECT_EQ(walker.touched(), "");
  }
}

TEST(Walk, GoesBackwardsSidewaysAndAround) {
  struct Case {
    const char* numbers;
    double x, y, yaw;  // after 5.4 s of walking
  };
  for (const Case& c : {Case{"forward=-0.1", -0.54, 0, 0}, Case{"forward=0, left=0.05", 0, 0.27, 0},
                        Case{"forward=0, left=-0.05", 0, -0.27, 0}, Case{"forward=0, turn=0.3", 0, 0, 1.6},
                        Case{"forward=0, turn=-0.3", 0, 0, -1.6}}) {
    SCOPED_TRACE(c.numbers);
    Walker walker(with("articulated", c.numbers));
    walker.run(8);
    EXPECT_NEAR(walker.pose().position.x(), c.x, 0.15);
    EXPECT_NEAR(walker.pose().position.y(), c.y, 0.1);
    EXPECT_NEAR(walker.yaw(), c.yaw, 0.3);
    expect_upright(walker);
  }
}

TEST(Walk, GoesFasterThanAQuarterOfAMetreInASecond) {
  Walker walker(with("articulated", "forward=0.25"));
  walker.run(10);
  EXPECT_GT(walker.pose().position.x(), 0.25 * 6);
  expect_upright(walker);
}

TEST(Walk, WalksWithoutAnyReading) {
  Walker walker({"robots.walker.imu=off", "robots.walker.imu_error=off"});
  walker.run(7);
  EXPECT_GT(walker.pose().position.x(), 0.4);
  expect_upright(walker);
}

TEST(Walk, OtherControlCodeSteers) {
  Walker walker({"robots.walker.steer={use: controller.library, library: patrol, rate: 25}"});
  walker.run(6);
  EXPECT_GT(walker.pose().position.x(), 0.2);
  EXPECT_NEAR(walker.yaw(), 0, 0.15);
  walker.run(6);
  EXPECT_GT(walker.yaw(), 1) << "it has turned to the left";
  expect_upright(walker);
}

TEST(Walk, SaysWhatItIsAndWhereItHasGone) {
  Walker walker;
  walker.run(1);
  EXPECT_EQ(walker.phase(), 0) << "it gets ready";
  walker.run(7);
  EXPECT_EQ(walker.phase(), 2);
  const double* odometry = walker.read("walk.odometry");
  EXPECT_NEAR(odometry[0], walker.pose().position.x(), 0.25 * walker.pose().position.x());
  EXPECT_NEAR(odometry[1], walker.pose().position.y(), 0.1);
}

TEST(Walk, SaysThatLegsAreTooShort) {
  Walker walker({tunables("trunk_height=0.3")});
  try {
    walker.run(0.1);
    FAIL() << "nothing is said";
  } catch (const std::exception& e) {
    EXPECT_NE(std::string(e.what()).find("trunk_height=0.300000 m is more than legs of 0.220150 m reach"),
              std::string::npos)
        << e.what();
  }
}

/// Expects 10 m of way in 120 s, less than 1 m to the side.
void expect_ten_metres(const std::string& motion) {
  for (int seed = 1; seed <= 5; ++seed) {
    SCOPED_TRACE(seed);
    Walker walker(with(motion, "forward=0.1", seed));
    walker.run(120);
    EXPECT_GT(walker.pose().position.x(), 10);
    EXPECT_LT(std::abs(walker.pose().position.y()), 1);
    expect_upright(walker);
  }
}

TEST(Walk, SlowTenMetresAtBiped) { expect_ten_metres("biped"); }
TEST(Walk, SlowTenMetresAtSimplified) { expect_ten_metres("simplified"); }
TEST(Walk, SlowTenMetresAtArticulated) { expect_ten_metres("articulated"); }
TEST(Walk, SlowTenMetresAtMujoco) { expect_ten_metres("mujoco"); }
TEST(Walk, SlowTenMetresAtBullet) { expect_ten_metres("bullet"); }

TEST(Walk, SlowTwentySecondsAtOde) {
  Walker walker(with("ode"));
  walker.run(20);
  EXPECT_GT(walker.pose().position.x(), 1.6);
  EXPECT_LT(std::abs(walker.pose().position.y()), 0.2);
  expect_upright(walker);
}

}  // namespace
}  // namespace muro::walk_test
