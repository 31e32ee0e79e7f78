// SPDX-License-Identifier: MIT
#include "host/scenario/scenario.hpp"

#include <gtest/gtest.h>

#include <filesystem>

#include "core/error.hpp"
#include "core/instance.hpp"
#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/complaint.hpp"
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
  const std::string path = folder.file(
      "s.yaml", "seed: -1\nworld:\n  gravity: [0, 0]\nrobots:\n  a: {cuont: 3, shape: {sphere: 1}, mass: 1}\n");
  try {
    read_scenario(path, {"duration=long"});
    FAIL();
  } catch (const SetupError& e) {
    EXPECT_EQ(
        std::string(e.what()),
        path + ":1:7: `seed` of the scenario is `-1` but must be a whole number from 0 to 9.0072e+15\n" +
            "--set duration=long: `duration` of the scenario is `long` but must be a number from 0 to 1e+09\n" + path +
            ":3:12: `gravity` of `world` is a list of 2 but must be a list of 3 numbers from -10000 to 10000\n" + path +
            ":5:7: robot `a` has no key `cuont` (did you mean `count`?); allowed: model, shape, mass, friction, "
            "restitution, "
            "color, texture, count, place, at, velocity, angular_velocity, joints, dynamics, materials, variants, and "
            "subsystems {use: "
            "NAME, ...}");
  }
}

TEST(Scenario, TexturesOfShapesAreFilesBesideIt) {
  const test::ScratchFolder folder;
  const std::string picture = folder.file("grass.png", "");
  const auto texts = [&](const std::string& texture, const std::string& more) {
    return folder.file("s.yaml", "world:\n  objects:\n    crate: {shape: {box: [1, 1, 1]}, texture: " + texture + more +
                                     "}\nrobots:\n  ball: {shape: {sphere: 1}, mass: 1, texture: grass.png}\n");
  };
  const Scenario plain = read_scenario(texts("grass.png", ""), {});
  EXPECT_EQ(plain.objects.at(0).texture, picture);
  EXPECT_EQ(plain.objects.at(0).shape.color, Eigen::Vector4d(1, 1, 1, 1)) << "the picture as it is";
  EXPECT_EQ(plain.objects.at(0).shape.material_source, MaterialSource::model);
  const Scenario tinted = read_scenario(texts("grass.png", ", color: [1, 0.5, 0]"), {});
  EXPECT_EQ(tinted.objects.at(0).shape.color, Eigen::Vector4d(1, 0.5, 0, 1));
  const std::string path = texts("gras.png", "");
  EXPECT_EQ(
      test::complaint_of([&] { read_scenario(path, {}); }),
      path + ":3:47: texture file " + folder.path("gras.png") +
          " does not exist (did you mean `grass.png`?); correct its path, which starts at the folder of this file");
}

TEST(Scenario, SequencesRunAsOneItemInTheirOwnOrder) {
  const std::string text = R"(
robots:
  a: {shape: {sphere: 0.1}, mass: 1, motion: {use: motion.point, rate: 20}}
  b: {shape: {sphere: 0.1}, mass: 1, at: {x: 5}, motion: {use: motion.point, rate: 20, max_speed: 1}}
schedule: {sequences: [[b.motion, a.motion]]}
)";
  const BuiltScenario built = build(read(text), test::plugins());
  const Scheduler& s = built.simulation->scheduler();
  const std::vector<TaskId> plan = s.order_at(50'000'000);
  ASSERT_EQ(plan.size(), 2u);
  EXPECT_EQ(s.tasks()[plan[0]].name, "b.motion");
  EXPECT_EQ(s.tasks()[plan[1]].name, "a.motion");
}

std::string rover(const std::string& rest) {
  return "robots:\n  rovers:\n    model: " MURO_TEST_SOURCE_DIR
         "/examples/models/rover.urdf\n    motion: {use: motion.point}\n" +
         rest;
}

TEST(Scenario, AnErrorRunsWithItsSensorUnlessItSaysOtherwise) {
  const std::string laser = "    laser: {use: laser.raycast, on: laser_link, rate: 12.5, phase: 0.25}\n";
  const auto setup_of = [](const BuiltScenario& b) {
    for (const auto& i : b.simulation->instances())
      if (i->setup().use == "sensor.error") return i->setup();
    return AlgorithmSetup{};
  };
  const BuiltScenario before =
      build(read(rover("    noise: {use: sensor.error, on: laser}\n" + laser)), test::plugins());
  EXPECT_EQ(setup_of(before).rate, Rate(12.5)) << "also when it stands before its sensor";
  EXPECT_EQ(setup_of(before).phase, 250'000'000);
  const BuiltScenario own =
      build(read(rover(laser + "    noise: {use: sensor.error, on: laser, rate: 5, phase: 0}\n")), test::plugins());
  EXPECT_EQ(setup_of(own).rate, Rate(5));
  EXPECT_EQ(setup_of(own).phase, 0);
}

TEST(Scenario, KinematicsIsAddedOnceAndCanBeReplacedOrSwitchedOff) {
  const auto count = [](const BuiltScenario& b) {
    std::size_t items = 0;
    for (const auto& i : b.simulation->instances())
      if (i->setup().use == "kinematics.direct") items += i->setup().items.size();
    return items;
  };
  EXPECT_EQ(count(build(read(rover("")), test::plugins())), 1u);
  EXPECT_EQ(count(build(read(rover("    bodies: {use: kinematics.direct, rate: 10}\n")), test::plugins())), 1u);
  EXPECT_EQ(count(build(read(rover("algorithms: {bodies: {use: kinematics.direct, rate: 10}}\n")), test::plugins())),
            1u);
  EXPECT_EQ(count(build(read(rover("algorithms: {kinematics: off}\n")), test::plugins())), 0u);
}

constexpr const char* crowd = R"(
world: {places: {yard: [{size: [3, 3]}]}}
robots:
  crowd: {shape: {sphere: 0.2}, mass: 1, count: 10, place: {random: yard}}
  fixed: {shape: {sphere: 0.6}, mass: 1}
)";

TEST(Scenario, RandomPlacesKeepClearOfGivenOnesInAnyOrder) {
  for (int seed = 0; seed < 20; ++seed) {
    const BuiltScenario b = build(read(crowd, {"seed=" + std::to_string(seed)}), test::plugins());
    const auto robots = b.simulation->world().robots();
    ASSERT_EQ(robots.size(), 11u);
    EXPECT_EQ(robots[10]->name, "fixed") << "robots are numbered as in the file";
    for (std::size_t i = 0; i < 10; ++i)
      EXPECT_GE(b.simulation->world().value(robots[i]->base(), keys::pose).position.head<2>().norm(), 0.9);
  }
}

TEST(Scenario, RandomPlacesFollowTheirOwnSeedOrTheScenarios) {
  const auto first = [](const std::vector<std::string>& overrides) -> Vec3 {
    const BuiltScenario b = build(read(crowd, overrides), test::plugins());
    return b.simulation->world().value("crowd_0/body", keys::pose).position;
  };
  EXPECT_EQ(first({}), first({"seed=1"}));
  EXPECT_NE(first({"seed=1"}), first({"seed=2"}));
  const std::string own = "robots.crowd.place.seed=7";
  EXPECT_EQ(first({own, "seed=1"}), first({own, "seed=2"}));
}

TEST(Scenario, OffIsGoodForWhatAnOverrideReplacesAndForWhatOthersHave) {
  EXPECT_TRUE(read(without_ground(), {"robots.balls.motion=off"}).robots[0].subsystems[0].empty());
  EXPECT_TRUE(read(without_ground(), {"robots.balls=OFF"}).robots.empty());
  EXPECT_EQ(read(without_ground(), {"algorithms.contact=off"}).switched_off, std::vector<std::string>{"contact"});
  EXPECT_TRUE(read(without_ground(), {"robots.balls[0].motion=off"}).robots[0].subsystems[0].empty());
}

TEST(Scenario, OverridesOfWhatIsNotThereNameTheNearest) {
  const auto error_of = [](const std::string& override) -> std::string {
    try {
      read(without_ground(), {override});
    } catch (const SetupError& e) {
      return e.what();
    }
    return "";
  };
  EXPECT_EQ(error_of("robots.balls.moton=off"),
            "--set robots.balls.moton=off: nothing is named `moton` in robot `balls`, so it cannot be switched off "
            "(did you mean "
            "`motion`?); there are: motion");
  EXPECT_EQ(error_of("robots.ball=off"),
            "--set robots.ball=off: nothing is named `ball` in `robots`, so it cannot be switched off (did you mean "
            "`balls`?); "
            "there are: balls");
  EXPECT_EQ(error_of("robots.bals.count=3"),
            "--set robots.bals.count=3: robot `bals` needs a `model: FILE`, or a `shape` with a `mass` (did you mean "
            "`balls`?)");
  EXPECT_EQ(error_of("algorithms.colision=off"),
            "--set algorithms.colision=off: nothing is named `colision` in `algorithms`, so it cannot be switched off "
            "(did you mean "
            "`collision`?); there are: collision, contact, index, kinematics");
  EXPECT_EQ(
      error_of("robots.balls[0]=1"),
      "--set robots.balls[0]=1: variant `0` of robot `balls` is `1` but must be a map of the subsystems that differ");
  EXPECT_EQ(
      error_of("robots.balls.motion="),
      "--set robots.balls.motion=: `motion` has no value; leave the key out, or write `off` to switch a part off");
}

TEST(Scenario, WrongParametersOfTheCommandLineAreBlamedOnIt) {
  const auto complaint = [](const std::string& override) {
    return test::complaint_of([&] { build(read(without_ground(), {override}), test::plugins()); });
  };
  EXPECT_SAYS(complaint("robots.balls.motion.max_speed=fast"),
              "--set robots.balls.motion.max_speed=fast: balls.motion: parameter `max_speed` is \"fast\" but must be a "
              "number");
  EXPECT_SAYS(complaint("robots.balls.motion.max_sped=1"),
              "--set robots.balls.motion.max_sped=1: balls.motion: `motion.point` has no parameter `max_sped`");
  EXPECT_SAYS(complaint("robots.balls[0].motion={use: motion.ode, rate: 100, iterations: 0}"),
              "--set robots.balls[0].motion={use: motion.ode, rate: 100, iterations: 0}: balls_0.motion: parameter "
              "`iterations` is 0 but must be");
}

TEST(Scenario, SequencesNameTheAlgorithmsOfAllRobotsOfATemplate) {
  Registry registry({MURO_TEST_PLUGIN_DIR, BAD_PLUGIN_DIR "/throws"});  // motion.step_throws is not batched
  const BuiltScenario built = build(read(R"(
robots:
  others: {shape: {sphere: 0.1}, mass: 1, motion: {use: motion.point, rate: 20}}
  balls:
    shape: {sphere: 0.1}
    mass: 1
    place: {list: [{x: 1}, {x: 2}]}
    motion: {use: motion.step_throws, rate: 20}
schedule: {sequences: [[balls.motion, others.motion]]}
)"),
                                    registry);
  std::vector<std::string> names;
  for (const TaskId t : built.simulation->scheduler().order_at(0))
    names.push_back(built.simulation->scheduler().tasks()[t].name);
  EXPECT_EQ(names, (std::vector<std::string>{"balls_0.motion", "balls_1.motion", "others.motion"}));
}

TEST(Scenario, ADefaultThatIsMissingSaysWhoNeedsIt) {
  const ScratchFolder folder;
  for (const char* plugin : {"laser_raycast", "reader_urdf", "motion_point", "kinematics_direct"})
    for (const char* ending : {".so", ".muro.json"})
      std::filesystem::create_symlink(std::string(MURO_TEST_PLUGIN_DIR "/") + plugin + ending,
                                      folder.path(std::string(plugin) + ending));
  Registry few({folder.path("")});
  try {
    build(read(rover("    laser: {use: laser.raycast, on: laser_link, rate: 10}\n")), few);
    FAIL();
  } catch (const SetupError& e) {
    EXPECT_NE(std::string(e.what()).find(
                  "s.yaml: `laser.raycast` reads `scene.index`, so something must write it, by default `scene.bvh` "
                  "(name another by `algorithms: {index: {use: NAME}}`): no plugin offers `scene.bvh`"),
              std::string::npos)
        << e.what();
  }
}

TEST(Scenario, VariantsOfManyRobotsAreReadOnce) {
  const Scenario s = read(R"(
robots:
  balls:
    shape: {sphere: 0.1}
    mass: 2
    count: 100000
    place: {grid: {count: [1000, 100]}}
    motion: {use: motion.point, rate: 100, motion.point: {max_speed: 3, max_acceleration: 1}}
    variants: {100-99998: {motion: {motion.point: {max_speed: 5}}}}
)");
  const auto& parameters = s.robots[0].subsystems[200][0].parameters;
  EXPECT_EQ(std::get<std::int64_t>(parameters.at("max_speed")), 5);
  EXPECT_EQ(std::get<std::int64_t>(parameters.at("max_acceleration")), 1) << "maps of variants are merged";
  EXPECT_EQ(std::get<std::int64_t>(s.robots[0].subsystems[99'999][0].parameters.at("max_speed")), 3);
}

}  // namespace
}  // namespace muro::host
