// SPDX-License-Identifier: MIT
// A world file in MJCF brings MuJoCo's friction rule, the larger of two coefficients, to all motions.
#include <gtest/gtest.h>

#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

/// Returns how far (m) a box without friction slides at 1 m/s on the file's floor, which has friction 0.5.
double way_of_a_box(const std::string& world) {
  const test::ScratchFolder folder;
  folder.file("floor.xml",
              "<mujoco><worldbody><geom type='plane' size='50 50 1' friction='0.5'/></worldbody></mujoco>");
  const std::string scenario =
      folder.file("s.yaml", "world: {file: floor.xml" + world +
                                "}\nrobots: {box: {shape: {box: [1, 1, 0.2]}, mass: 1, friction: 0, "
                                "velocity: [1, 0, 0], motion: {use: motion.simplified}}}\n");
  const BuiltScenario built = build(read_scenario(scenario, {}), test::plugins());
  built.simulation->run_for(1);
  return built.simulation->world().value("box/body", keys::pose).position.x();
}

TEST(MjcfSceneryOfAScenario, BringsTheLargerFriction) {
  EXPECT_NEAR(way_of_a_box(""), 1.0 / (2 * 0.5 * 9.81), 0.005);  // v^2 / (2 mu g)
  EXPECT_NEAR(way_of_a_box(", friction: {combine: min}"), 1, 1e-3) << "the scenario has the last word";
}

}  // namespace
}  // namespace muro::host
