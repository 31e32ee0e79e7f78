// SPDX-License-Identifier: MIT
// A humanoid among others looks for the ball by its camera; the true place of the ball is known.
#include <gtest/gtest.h>

#include "examples/common/robot_testing.hpp"
#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

constexpr const char* scene = R"(
world: {file: SOCCER/field.sdf}
robots:
  player: &player
    model: MODELS/humanoid.urdf
    motion: {use: motion.biped, rate: 100, feet: [l_foot_link, r_foot_link], interpolate: 0.01}
    joints: {l_sho_roll: -1.3, r_sho_roll: 1.3, head_tilt: 0.3}
    camera: {use: camera.opengl, on: camera_link, rate: 10, width: 320, height: 240, horizontal_fov: 1.0123, shadows: false}
    imu: {use: sensor.imu, on: imu_link, rate: 10}
    look:
      use: controller.library
      library: look
      rate: 10
      inputs: ["joint.position=head_pan:joint.position,head_tilt:joint.position"]
      outputs: ["joint.position.target=head_pan:joint.position.target,head_tilt:joint.position.target"]
      tunables: [trunk_height=0.279]
  others:
    <<: *player
    count: 3
    place: {list: [{x: 1.1, y: -0.25, yaw: 2}, {x: 2, y: 0.9, yaw: -2}, {x: 3.5, y: -0.2, yaw: 3}]}
    materials: {team: {color: [0.8, 0.08, 0.08]}}
    camera: off
    imu: off
    look: off
  ball: {shape: {sphere: 0.07}, mass: 0.205, color: [1, 1, 1], texture: SOCCER/ball.png, at: {BALL}, motion: {use: motion.point}}
)";

/// Returns the player's report on the ball: whether it sees it, x, y (m), and the age of this sight (s).
std::vector<double> seen_after(double seconds, const std::string& ball) {
  const test::ScratchFolder folder;
  std::string text = scene;
  const auto replace = [&](const std::string& what, const std::string& by) {
    for (std::size_t at = text.find(what); at != std::string::npos; at = text.find(what, at + by.size()))
      text.replace(at, what.size(), by);
  };
  replace("SOCCER", MURO_TEST_SOURCE_DIR "/examples/soccer");
  replace("MODELS", MURO_TEST_SOURCE_DIR "/examples/models");
  replace("BALL", ball);
  BuiltScenario built = build(read_scenario(folder.file("look.yaml", text), {}), test::plugins());
  Simulation& s = *built.simulation;
  s.run_for(seconds);
  return example_test::values_of(s.world(), s.world().find_robot("player")->base(), "ball.seen", "1, m, m, s");
}

TEST(Look, FindsTheBallWithinCentimetres) {
  for (const auto& [x, y] : {std::pair(0.6, 0.15), std::pair(1.5, 0.2), std::pair(2.6, -1.1)}) {
    const std::vector<double> seen = seen_after(0.65, "x: " + std::to_string(x) + ", y: " + std::to_string(y));
    ASSERT_EQ(seen[0], 1) << x << ", " << y;
    const double distance = std::hypot(x, y);
    EXPECT_NEAR(seen[1], x, 0.005 + 0.02 * distance);
    EXPECT_NEAR(seen[2], y, 0.005 + 0.02 * distance);
  }
}

TEST(Look, TakesNoPlayerAndNoLineForABall) {
  const std::vector<double> seen = seen_after(2, "x: -1, y: 0");  // behind it
  EXPECT_EQ(seen[0], 0);
  EXPECT_GT(seen[3], 1) << "s: it has never seen one";
}

}  // namespace
}  // namespace muro::host
