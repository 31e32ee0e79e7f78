// SPDX-License-Identifier: MIT
#include "host/scenario/scenario.hpp"

#include <gtest/gtest.h>

#include "core/error.hpp"
#include "core/instance.hpp"
#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

using test::ScratchFolder;

constexpr const char* team = R"(
world:
  objects:
    ground: plane_is_below
robots:
  balls:
    shape: {sphere: 0.1}
    mass: 2
    count: 4
    place: {list: [{x: 1}, {x: 2}, {x: 3}, {x: 4, z: 5}]}
    motion: {use: motion.point, rate: 100, max_speed: 3}
    variants:
      1-2: {motion: {rate: 50}}
      3: {motion: off}
)";

Scenario read(const std::string& text, const std::vector<std::string>& overrides = {}) {
  const ScratchFolder folder;
  return read_scenario(folder.file("s.yaml", text), overrides);
}

std::string without_ground() {
  std::string text = team;
  const std::string line = "    ground: plane_is_below\n";
  return text.replace(text.find(line), line.size(), "    ground: {shape: plane}\n");
}

TEST(Scenario, VariantsChangeSomeRobotsOfATemplate) {
  const Scenario s = read(without_ground());
  ASSERT_EQ(s.robots.size(), 1u);
  const auto& subsystems = s.robots[0].subsystems;
  ASSERT_EQ(subsystems.size(), 4u);
  EXPECT_EQ(subsystems[0][0].rate, 100);
  EXPECT_EQ(subsystems[1][0].rate, 50);
  EXPECT_EQ(std::get<std::int64_t>(subsystems[2][0].parameters.at("max_speed")), 3) << "the rest is kept";
  EXPECT_TRUE(subsystems[3].empty()) << "switched off";
}

TEST(Scenario, RobotsOfOneAlgorithmAndRateShareAnInstance) {
  const BuiltScenario b = build(read(without_ground()), test::plugins());
  ASSERT_EQ(b.simulation->instances().size(), 2u);
  EXPECT_EQ(b.simulation->instances()[0]->setup().items.size(), 1u);
  EXPECT_EQ(b.simulation->instances()[1]->setup().items.size(), 2u);
}

TEST(Scenario, RobotsStandOnTheGroundUnlessTheySayOtherwise) {
  const BuiltScenario b = build(read(without_ground()), test::plugins());
  const World& w = b.simulation->world();
  EXPECT_EQ(w.value("balls_0/body", keys::pose).position, Vec3(1, 0, 0.1));
  EXPECT_EQ(w.value("balls_3/body", keys::pose).position, Vec3(4, 0, 5)) << "without motion it is parked";
  EXPECT_NEAR(w.value("balls_0/body", keys::inertial).ixx, 0.4 * 2 * 0.01, 1e-15);
}

TEST(Scenario, ParametersUnderAnAlgorithmsNameCountOnlyForIt) {
  const std::string text = R"(
robots:
  ball:
    shape: {sphere: 0.1}
    mass: 2
    motion: {use: motion.point, rate: 100, motion.point: {max_speed: 3}, motion.simplified: {joints: velocity}}
)";
  const Scenario s = read(text);
  EXPECT_EQ(s.robots[0].subsystems[0][0].parameters.size(), 1u);
  const Scenario other = read(text, {"robots.ball.motion.use=motion.simplified"});
  EXPECT_EQ(other.robots[0].subsystems[0][0].parameters.count("joints"), 1u);
}

TEST(Scenario, TellsAllProblemsAtOnceWithTheirPlaces) {
  const ScratchFolder folder;
  const std::string path = folder.file("s.yaml", "seed: -1\nworld:\n  gravity: [0, 0]\nrobots:\n  a: {cuont: 3, shape: {sphere: 1}, mass: 1}\n");
  try {
    read_scenario(path, {"duration=long"});
    FAIL();
  } catch (const SetupError& e) {
    EXPECT_EQ(std::string(e.what()),
              path + ":1:7: `seed` of the scenario is `-1` but must be a whole number from 0 to 9.0072e+15\n" +
                  "--set duration=long: `duration` of the scenario is `long` but must be a number from 0 to 1e+09\n" + path +
                  ":3:12: `gravity` of `world` is a list of 2 but must be a list of 3 numbers\n" + path +
                  ":5:7: robot `a` has no key `cuont` (did you mean `count`?); allowed: model, shape, mass, friction, restitution, "
                  "color, count, place, at, velocity, angular_velocity, joints, variants, and subsystems {use: NAME, ...}");
  }
}

TEST(Scenario, SequencesRunAsOneItemInTheirOwnOrder) {
  const std::string text = R"(
robots:
  a: {shape: {sphere: 0.1}, mass: 1, motion: {use: motion.point, rate: 10}}
  b: {shape: {sphere: 0.1}, mass: 1, at: {x: 5}, motion: {use: motion.point, rate: 20, max_speed: 1}}
schedule: {sequences: [[b.motion, a.motion]]}
)";
  const BuiltScenario built = build(read(text), test::plugins());
  const Scheduler& s = built.simulation->scheduler();
  const std::vector<TaskId> plan = s.plan_at(50'000'000);
  ASSERT_EQ(plan.size(), 2u) << "both at the 20 Hz of the first";
  EXPECT_EQ(s.tasks()[plan[0]].name, "b.motion");
  EXPECT_EQ(s.tasks()[plan[1]].name, "a.motion");
}

}  // namespace
}  // namespace muro::host
