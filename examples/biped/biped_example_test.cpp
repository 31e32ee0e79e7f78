// SPDX-License-Identifier: MIT
// Humanoids whose joints follow the clock walk as far as the lengths of their legs say.
#include <gtest/gtest.h>

#include "host/scenario/builder.hpp"
#include "muro/toolkit/rotations.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

/// Returns the distance (m) from hip to ankle, for two bones of these lengths (m) and a knee of 0.6 rad.
double leg_of(double thigh, double shin) {
  return std::sqrt(thigh * thigh + shin * shin + 2 * thigh * shin * std::cos(0.6));
}

TEST(BipedExample, WalksAndKicksABall) {
  BuiltScenario built = build(read_scenario(MURO_TEST_SOURCE_DIR "/examples/biped/biped.yaml", {}), test::plugins());
  Simulation& s = *built.simulation;
  const World& world = s.world();
  const auto pose = [&](const char* robot) { return world.value(std::string(robot) + "/base_link", keys::pose); };
  const double step = 2 * leg_of(0.11015, 0.11) * std::sin(0.25), step_back = 2 * leg_of(0.11015, 0.11) * std::sin(0.2);
  s.run_for(2.0);
  const Vec3 start = pose("straight").position, start_back = pose("backward").position;
  double lowest = 1, highest = 0, fastest = 0;
  for (int k = 0; k < 400; ++k) {
    s.run_for(0.02);
    lowest = std::min(lowest, pose("straight").position.z());
    highest = std::max(highest, pose("straight").position.z());
    fastest = std::max(fastest, world.value("ball/body", keys::twist).linear.norm());
  }
  const Vec3 way = pose("straight").position - start;
  EXPECT_NEAR(way.x(), 20 * step, 0.01 * 20 * step) << "20 steps of 0.4 s";
  EXPECT_LT(std::abs(way.y()), 1e-3);
  EXPECT_NEAR(pose("backward").position.x() - start_back.x(), -16 * step_back, 0.01 * 16 * step_back);
  EXPECT_GT(lowest, 0.2) << "it neither falls nor sinks";
  EXPECT_LT(highest, 0.28);
  EXPECT_GT(fastest, 0.3) << "the ball is kicked";
  EXPECT_GT(world.value("ball/body", keys::pose).position.x(), 1.2);
}

TEST(BipedExample, TurnsByTheSameAngleInEachStep) {
  BuiltScenario built = build(read_scenario(MURO_TEST_SOURCE_DIR "/examples/biped/biped.yaml", {}), test::plugins());
  Simulation& s = *built.simulation;
  const auto yaw = [&] { return yaw_of(s.world().value("circle/base_link", keys::pose).orientation); };
  s.run_for(2);
  const double before = yaw();
  s.run_for(8);
  EXPECT_NEAR(std::remainder(yaw() - before - 20 * 0.15, 2 * M_PI), 0, 0.01) << "20 steps";
}

}  // namespace
}  // namespace muro::host
