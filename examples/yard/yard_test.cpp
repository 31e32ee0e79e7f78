// SPDX-License-Identifier: MIT
// The yard, run as a user runs it, and checked by its state.
#include <gtest/gtest.h>

#include "host/scenario/builder.hpp"
#include "muro/toolkit/rotations.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

const std::string yard = MURO_TEST_SOURCE_DIR "/examples/yard/yard.yaml";
const std::string muro_program =
    std::string("cd " MURO_TEST_SOURCE_DIR " && MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " ") + MURO_PROGRAM;

BuiltScenario open(const std::vector<std::string>& overrides = {}) {
  return build(read_scenario(yard, overrides), test::plugins());
}

TEST(Yard, RunsAsItsReadmeSays) {
  const auto result = test::run_command(muro_program + " run examples/yard/yard.yaml --duration 2");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(result.output.substr(0, result.output.find("yard: 2 s")),
            "examples/yard/yard.sdf:6:5: note: <physics> in <world> is left out: the scenario names what moves each "
            "robot, and how often\n"
            "examples/yard/yard.sdf:10:5: note: <light> in <world> is left out: there are no lights\n"
            "examples/yard/yard.sdf: note: model `parked` is static, because the scenario does not name it; write "
            "`robots: {parked: {model: "
            "world, ...}}` to move it\n");
}

TEST(Yard, HoldsWhatItsFileDescribes) {
  const BuiltScenario built = open();
  const World& world = built.simulation->world();
  for (const char* name :
       {"ground", "walls.north", "walls.south", "walls.east", "walls.west", "shed.body", "shed.roof", "ramp", "barrel",
        "parked.base_link", "parked.rear_left_wheel", "rover/base_link", "rover/laser"})
    EXPECT_NE(world.find_object(name), no_object) << name;
  EXPECT_EQ(world.robots().size(), 1u);
  // the base is the link, 0.09 m above the frame of the model
  const Pose& rover = world.value("rover/base_link", keys::pose);
  EXPECT_TRUE(rover.position.isApprox(Vec3(-2, -2, 0.09), 1e-12));
  EXPECT_TRUE(rover.orientation.isApprox(from_rpy(0, 0, 0.4), 1e-12));
}

TEST(Yard, TheRoverDrivesWithinTheWallsAndTheParkedOneStands) {
  BuiltScenario built = open();
  World& world = built.simulation->world();
  const Pose parked = world.value("parked.base_link", keys::pose);
  double travelled = 0;
  Vec3 last = world.value("rover/base_link", keys::pose).position;
  for (int i = 0; i < 200; ++i) {
    built.simulation->run_for(0.1);
    const Vec3 now = world.value("rover/base_link", keys::pose).position;
    travelled += (now - last).norm();
    last = now;
    ASSERT_LT(std::max(std::abs(now.x()), std::abs(now.y())), 5.9);
    ASSERT_GT(now.z(), 0.05);
  }
  EXPECT_GT(travelled, 3);
  EXPECT_EQ(world.value("parked.base_link", keys::pose).position, parked.position);
}

TEST(Yard, ItsScanSeesTheParkedRoverAndTheBarrel) {
  // from the middle, turned to the barrel at 2 -2: its nearest point is sqrt(8) - 0.3 m away
  BuiltScenario built =
      open({"robots.rover.control=off", "robots.rover.drive=off", "robots.rover.motion.use=motion.point"});
  World& world = built.simulation->world();
  const Pose at{{0, 0, 0.09}, from_rpy(0, 0, -M_PI / 4)};
  world.value("rover/base_link", keys::pose) = at;
  built.simulation->run_for(0.2);
  const auto ranges = world.values(world.object("rover/laser"), keys::ranges);
  const double nearest = *std::min_element(ranges.begin(), ranges.end());
  EXPECT_NEAR(nearest, std::sqrt(8.0) - 0.3 - 0.1, 1e-3);  // the scanner sits 0.1 m in front of the base
}

}  // namespace
}  // namespace muro::host
