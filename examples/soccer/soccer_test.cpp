// SPDX-License-Identifier: MIT
// Two teams stand on the field and do their exercises, a forward kicks the ball, and cameras see the game.
#include <gtest/gtest.h>

#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

const std::string soccer_folder = MURO_TEST_SOURCE_DIR "/examples/soccer/";

TEST(Soccer, TwoTeamsStandAndAForwardKicksTheBall) {
  BuiltScenario built = build(read_scenario(soccer_folder + "soccer.yaml", {}), test::plugins());
  Simulation& s = *built.simulation;
  const World& world = s.world();
  ASSERT_EQ(world.robots().size(), 23u);
  double least = 1, most = 0;  // rad, of the knee of the keeper, which squats
  for (int k = 0; k < 20; ++k) {
    s.run_for(0.1);
    const double knee = world.value("blue_0/l_knee", keys::joint_position);
    least = std::min(least, knee);
    most = std::max(most, knee);
    for (const RobotView* r : world.robots()) {
      if (r->name == "ball") continue;
      const Pose& base = world.value(r->base(), keys::pose);
      // upright on straight legs the base is at 0.279 m
      ASSERT_GT(base.position.z(), 0.2) << r->name << " after " << 0.1 * (k + 1) << " s";
      ASSERT_LT(base.position.z(), 0.29) << r->name;
      ASSERT_GT((base.orientation * Vec3::UnitZ()).z(), 0.9) << r->name;
    }
  }
  EXPECT_NEAR(most - least, 4 * 0.25, 0.25) << "thighs bend by 0.25 rad to either side, knees by twice as much";
  EXPECT_GT(world.value("ball/body", keys::pose).position.x(), 0.2) << "half a second after the kick";
  EXPECT_GT(world.value("ball/body", keys::twist).linear.x(), 0.3);
  EXPECT_NEAR(world.value("ball/body", keys::pose).position.z(), 0.07, 0.01);
}

TEST(Soccer, CamerasSeeGrassLinesAndPlayers) {
  const Scenario scenario =
      read_scenario(soccer_folder + "cameras.yaml",
                    {"robots.red.camera=off", "robots.blue[0-2].camera=off", "robots.blue[4-9].camera=off"});
  BuiltScenario built = build(scenario, test::plugins());
  Simulation& s = *built.simulation;
  s.run_for(0.04);
  const auto image = s.world().values(s.world().object("blue_3/camera"), keys::camera_image);
  ASSERT_EQ(image.size(), 320u * 240 * 3);
  int green = 0, white = 0, red = 0;
  for (std::size_t i = 0; i < image.size(); i += 3) {
    const int r = image[i], g = image[i + 1], b = image[i + 2];
    green += g > 1.4 * r && g > 1.4 * b;
    white += std::min({r, g, b}) > 200 && std::max({r, g, b}) < 254;
    red += r > 100 && r > 3 * g && r > 3 * b;
  }
  EXPECT_GT(green, 0.15 * 320 * 240);
  EXPECT_GT(white, 100);
  EXPECT_GT(red, 20) << "red players are ahead";
}

}  // namespace
}  // namespace muro::host
