// SPDX-License-Identifier: MIT
// A humanoid that has fallen gets up and walks on.
#include <gtest/gtest.h>

#include <regex>

#include "tests/support/files.hpp"
#include "walk_testing.hpp"

namespace muro::walk_test {
namespace {

/// Expects a walk within `seconds`.
void expect_to_walk(Walker& walker, double seconds) {
  for (int k = 0; k < std::lround(seconds / 0.4) && walker.phase() != 2; ++k) walker.run(0.4);
  EXPECT_EQ(walker.phase(), 2) << "it walks";
  EXPECT_GT(walker.pose().position.z(), 0.245);
}

/// Pushes it over forwards or backwards by 3 N s. It lies; then it stands and walks again.
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
  expect_to_walk(walker, 8);
  const Vec3 before = walker.pose().position;
  const double yaw = walker.yaw();
  walker.run(2);
  EXPECT_GT((walker.pose().position - before).dot(Vec3(std::cos(yaw), std::sin(yaw), 0)), 0.1);
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

/// The humanoid with a thigh of 0.095 m and a shin of 0.105 m.
TEST(GetUp, OneWithShorterLegsTakesTheSamePosesByItsNumbers) {
  const std::string models = MURO_TEST_SOURCE_DIR "/examples/models/";
  std::string model = test::text_of(models + "humanoid.urdf");
  model = std::regex_replace(model, std::regex("\"meshes/"), "\"" + models + "meshes/");
  model = std::regex_replace(model, std::regex("\"0 0 -0.11015\""), "\"0 0 -0.095\"");
  model = std::regex_replace(model, std::regex("\"0 0 -0.11\""), "\"0 0 -0.105\"");
  const test::ScratchFolder folder;
  for (const char* pitch : {"1.57", "-1.57"}) {
    SCOPED_TRACE(pitch);
    Walker walker({"robots.walker.model=" + folder.file("shorter.urdf", model),
                   std::string("robots.walker.at={pitch: ") + pitch + "}",
                   tunables("thigh=0.095, shin=0.105, trunk_height=0.237")});
    walker.run(10);
    EXPECT_EQ(walker.phase(), 2);
    EXPECT_GT(walker.pose().position.z(), 0.227);
  }
}

/// Expects it to get up from belly and back, 12 starts each, or every `stride`-th of these, on a floor of friction 0.6.
void expect_getting_up_where_it_slides(const std::string& motion, int stride) {
  SCOPED_TRACE(motion);
  for (int i = 0; i < 24; i += stride) {
    char place[80];
    std::snprintf(place, sizeof place, "robots.walker.at={pitch: %.2f, yaw: %.1f}",
                  (i < 12 ? 1 : -1) * (1.4 + 0.03 * (i % 12)), 0.5 * i);
    SCOPED_TRACE(place);
    Walker walker({"robots.walker.motion.use=motion." + motion, place, "world.objects.ground.friction=0.6"});
    expect_to_walk(walker, 12);
  }
}

TEST(GetUp, From24StartsWhereItSlides) { expect_getting_up_where_it_slides("articulated", 1); }
TEST(GetUp, SlowWhereItSlidesInEngines) {
  for (const char* motion : {"mujoco", "bullet", "ode"}) expect_getting_up_where_it_slides(motion, 6);
}

TEST(GetUp, SlowInOtherEngines) {
  for (const char* motion : {"bullet", "ode"})
    for (const double direction : {1, -1}) expect_getting_up(motion, direction);
}

}  // namespace
}  // namespace muro::walk_test
