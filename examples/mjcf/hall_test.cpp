// SPDX-License-Identifier: MIT
// The hall, run as a user runs it, and checked by its state.
#include <gtest/gtest.h>

#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

const std::string hall = MURO_TEST_SOURCE_DIR "/examples/mjcf/hall.yaml";
const std::string muro_program =
    std::string("cd " MURO_TEST_SOURCE_DIR " && MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " ") + MURO_PROGRAM;

BuiltScenario open(const std::vector<std::string>& overrides = {}) {
  return build(read_scenario(hall, overrides), test::plugins());
}

TEST(Hall, RunsWithoutAWarning) {
  const auto result = test::run_command(muro_program + " run examples/mjcf/hall.yaml --duration 1");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(result.output.find("warning"), std::string::npos) << result.output;
}

TEST(Hall, ServosOfTheFileHoldTheArm) {
  // at rest the error of a servo of gain 60 N m/rad is the torque of gravity divided by this gain
  BuiltScenario built = open();
  World& world = built.simulation->world();
  built.simulation->run_for(5);
  for (const auto& [joint, start] : {std::pair("arm/shoulder", 0.8), std::pair("arm/elbow", 0.6)}) {
    const double position = world.value(world.object(joint), keys::joint_position);
    EXPECT_NEAR(position, start, 0.4) << joint;
    EXPECT_GT(std::abs(position - start), 1e-3) << joint;
    EXPECT_NEAR(world.value(world.object(joint), keys::joint_velocity), 0, 1e-4) << joint;
    EXPECT_NEAR(world.value(world.object(joint), keys::joint_effort), 60 * (start - position), 1e-3) << joint;
  }
}

TEST(Hall, JointsBeginAsInTheFileUnlessTheScenarioSaysOther) {
  const BuiltScenario as_in_file = open(), at_zero = open({"robots.arm.joints.yaw=0"});
  const auto start = [](const BuiltScenario& built, const char* joint) {
    const World& world = built.simulation->world();
    return world.value(world.object(joint), keys::joint_position);
  };
  EXPECT_NEAR(start(as_in_file, "arm/yaw"), 10 * M_PI / 180, 1e-12);
  EXPECT_EQ(start(at_zero, "arm/yaw"), 0);
  EXPECT_EQ(start(as_in_file, "arm/shoulder"), 0.8);
}

TEST(Hall, TheBallLiesOnTheFloor) {
  BuiltScenario built = open();
  built.simulation->run_for(5);
  EXPECT_NEAR(built.simulation->world().value("ball/ball", keys::pose).position.z(), 0.1, 2e-3);
}

TEST(Hall, InOtherMotionsJointsFollowWhatTheFileDrivesThemBy) {
  // the rest position of the arm follows from the gains of its servos and its weight, with any motion
  BuiltScenario as_in_file = open(),
                by_bullet =
                    open({"robots.arm.motion={use: motion.bullet, base: fixed, rate: 500, shadow: {use: motion.ode, "
                          "base: fixed}}"});
  for (BuiltScenario* built : {&as_in_file, &by_bullet}) {
    World& world = built->simulation->world();
    world.value(world.object("arm/yaw"), keys::joint_position_target) = 0.5;
    built->simulation->run_for(5);
  }
  const auto position = [](const BuiltScenario& built, const std::string& joint) {
    const World& world = built.simulation->world();
    return world.value(world.object(joint), keys::joint_position);
  };
  EXPECT_NEAR(position(by_bullet, "arm/yaw"), 0.5, 1e-3);
  for (const std::string joint : {"yaw", "shoulder", "elbow"}) {
    EXPECT_NEAR(position(by_bullet, "arm/" + joint), position(as_in_file, "arm/" + joint), 1e-3) << joint;
    EXPECT_NEAR(position(by_bullet, "arm.shadow/" + joint), position(as_in_file, "arm/" + joint), 1e-3) << joint;
  }
}

}  // namespace
}  // namespace muro::host
