// SPDX-License-Identifier: MIT
// A humanoid that has fallen gets up and walks on.
#include <gtest/gtest.h>

#include "walk_testing.hpp"

namespace muro::walk_test {
namespace {

/// Pushed over forwards or backwards by 3 N s, it lies; then it stands and walks again.
void expect_getting_up(const std::string& motion, double direction) {
  SCOPED_TRACE(motion);
  Walker walker({"robots.walker.motion.use=motion." + motion});
  walker.run(3.2);
  walker.push(Vec3(30 * direction, 0, 0));
  walker.run(0.104);
  walker.push(Vec3::Zero());
  walker.run(1.2);
  EXPECT_GE(walker.phase(), 3) << "it has fallen";
  EXPECT_LT(walker.pose().position.z(), 0.12);
  EXPECT_EQ((walker.pose().orientation * Vec3::UnitX()).z() < 0, direction > 0) << "on its belly or its back";
  walker.run(8);
  EXPECT_EQ(walker.phase(), 2) << "it walks";
  EXPECT_GT(walker.pose().position.z(), 0.245);
  const Vec3 before = walker.pose().position;
  const double yaw = walker.yaw();
  walker.run(3);
  EXPECT_GT((walker.pose().position - before).dot(Vec3(std::cos(yaw), std::sin(yaw), 0)), 0.15);
  EXPECT_GT(walker.upright(), 0.98);
}

TEST(GetUp, FromTheBellyAtArticulated) { expect_getting_up("articulated", 1); }
TEST(GetUp, FromTheBellyAtMujoco) { expect_getting_up("mujoco", 1); }
TEST(GetUp, FromTheBackAtArticulated) { expect_getting_up("articulated", -1); }
TEST(GetUp, FromTheBackAtMujoco) { expect_getting_up("mujoco", -1); }

TEST(GetUp, OneThatLiesAtTheStartGetsUp) {
  Walker walker({"robots.walker.at={pitch: -1.57}"});
  walker.run(11);
  EXPECT_EQ(walker.phase(), 2);
  EXPECT_GT(walker.pose().position.z(), 0.245);
}

TEST(GetUp, SlowInOtherEngines) {
  for (const char* motion : {"bullet", "ode"}) expect_getting_up(motion, 1);
  expect_getting_up("bullet", -1);
}

}  // namespace
}  // namespace muro::walk_test
