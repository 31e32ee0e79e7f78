// SPDX-License-Identifier: MIT
// `world: {file: ...}` of a scenario, as a user uses it.
#include <gtest/gtest.h>

#include "host/scenario/builder.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

constexpr char shape[] = "<collision name='c'><geometry><box><size>1 1 1</size></box></geometry></collision>";
constexpr char inertial[] =
    "<inertial><mass>1</mass><inertia><ixx>1</ixx><ixy>0</ixy><ixz>0</ixz><iyy>1</iyy><iyz>0</iyz><izz>1</izz></"
    "inertia></inertial>";

const std::string muro_program = std::string("MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " ") + MURO_PROGRAM;

std::string link(const std::string& name, const std::string& pose = "0 0 0 0 0 0") {
  return "<link name='" + name + "'><pose>" + pose + "</pose>" + shape + inertial + "</link>";
}

/// A folder with world.sdf (`world`, from line 2 on) and a scenario.
class WorldFile {
 public:
  WorldFile(const std::string& world, const std::string& scenario) {
    folder_.file("world.sdf", "<sdf version='1.9'><world name='w'>\n" + world + "\n</world></sdf>");
    scenario_ = folder_.file("s.yaml", scenario);
  }
  BuiltScenario open(const std::vector<std::string>& overrides = {}) const {
    return build(read_scenario(scenario_, overrides), test::plugins());
  }
  /// Returns the output of `muro check`, with paths relative to the folder.
  test::CommandResult check() const {
    return test::run_command("cd " + folder_.path("") + " && " + muro_program + " check s.yaml");
  }

 private:
  test::ScratchFolder folder_;
  std::string scenario_;
};

const std::string crate = "<model name='crate'><pose>1 2 0.5 0 0 0</pose>" + link("body") + "</model>";
const std::string house =
    "<model name='house'><static>true</static><pose>-4 0 0.5 0 0 0</pose>" + link("wall") + "</model>";

TEST(WorldFileOfAScenario, BringsSceneryGravityAndTheModelsThatTheScenarioNames) {
  const WorldFile file("<gravity>0 0 -3.7</gravity>" + crate + house,
                       "world: {file: world.sdf, objects: {ground: {shape: plane}}}\n"
                       "robots: {crate: {model: world, motion: {use: motion.simplified}, velocity: [1, 0, 0]}}\n");
  BuiltScenario built = file.open();
  World& world = built.simulation->world();
  EXPECT_EQ(built.notes, std::vector<std::string>{});
  EXPECT_EQ(world.value(world_object, keys::gravity), Vec3(0, 0, -3.7));
  EXPECT_EQ(world.value("house", keys::pose).position, Vec3(-4, 0, 0.5));
  EXPECT_NE(world.find_object("ground"), no_object);
  EXPECT_EQ(world.value("crate/body", keys::pose).position, Vec3(1, 2, 0.5));
  EXPECT_EQ(world.value("crate/body", keys::twist).linear, Vec3(1, 0, 0));
}

TEST(WorldFileOfAScenario, GravityOfTheScenarioGoesBeforeThatOfTheFile) {
  const WorldFile file("<gravity>0 0 -3.7</gravity>" + house, "world: {file: world.sdf, gravity: [0, 0, -1]}\n");
  EXPECT_EQ(file.open().simulation->world().value(world_object, keys::gravity), Vec3(0, 0, -1));
}

/// Returns how far a block of friction 0.2 slides at 1 m/s on a floor of 0.8, in a world of MuJoCo.
double sliding_distance(const std::string& more_of_world) {
  const test::ScratchFolder folder;
  folder.file("yard.xml",
              "<mujoco><worldbody><geom name='floor' type='plane' size='5 5 1' friction='0.8'/><body name='block' "
              "pos='0 0 0.05'><freejoint/><geom type='box' size='0.2 0.2 0.05' friction='0.2'/></body></worldbody>"
              "</mujoco>");
  const std::string scenario = folder.file(
      "s.yaml", "world: {file: yard.xml" + more_of_world +
                    "}\nrobots: {block: {model: world, motion: {use: motion.simplified}, velocity: [1, 0, 0]}}\n");
  BuiltScenario built = build(read_scenario(scenario, {}), test::plugins());
  built.simulation->run_for(3);
  return built.simulation->world().value("block/block", keys::pose).position.x();
}

TEST(WorldFileOfAScenario, FrictionOfMuJoCoIsTheLargerUnlessTheScenarioSaysOther) {
  const double g = 9.81;
  EXPECT_NEAR(sliding_distance(""), 1 / (2 * 0.8 * g), 0.003);
  EXPECT_NEAR(sliding_distance(", friction: {combine: min}"), 1 / (2 * 0.2 * g), 0.003);
}

TEST(WorldFileOfAScenario, AModelThatNobodyNamesIsStaticAndReported) {
  const WorldFile file(crate, "world: {file: world.sdf}\n");
  BuiltScenario built = file.open();
  EXPECT_EQ(built.simulation->world().value("crate.body", keys::pose).position, Vec3(1, 2, 0.5));
  ASSERT_EQ(built.notes.size(), 1u);
  EXPECT_NE(built.notes[0].find("note: model `crate` is static, because the scenario does not name it"),
            std::string::npos);
}

TEST(WorldFileOfAScenario, AModelThatIsNoTreeIsMadeOneWithAWarning) {
  const std::string pile = "<model name='pile'>" + link("a") + "\n" + link("b", "0 0 1 0 0 0") + "</model>";
  const WorldFile still(pile, "world: {file: world.sdf}\n");
  EXPECT_EQ(still.open().simulation->world().value("pile.b", keys::pose).position, Vec3(0, 0, 1));
  EXPECT_EQ(still.check().exit_code, 0);
  const WorldFile robot(pile,
                        "world: {file: world.sdf}\nrobots:\n  pile: {model: world, motion: {use: motion.point}}\n");
  EXPECT_NE(robot.open().simulation->world().find_object("pile/b"), no_object);
  EXPECT_EQ(robot.check().exit_code, 0);
  EXPECT_NE(robot.check().output.find("world.sdf:3:1: warning: no joint leads to link `b`; it is fixed to the base, "
                                      "link `a`. What is to move freely is a model of its own\n"),
            std::string::npos)
      << robot.check().output;
}

TEST(WorldFileOfAScenario, ABadModelIsToldAndTheRestIsThere) {
  const WorldFile file("<model name='m'><link name='a'><pose>1 2</pose></link></model>" + crate + house,
                       "world: {file: world.sdf}\nrobots: {crate: {model: world}}\n");
  const BuiltScenario built = file.open();
  EXPECT_NE(built.simulation->world().find_object("house"), no_object);
  EXPECT_NE(built.simulation->world().find_object("crate/body"), no_object);
  const auto check = file.check();
  EXPECT_EQ(check.exit_code, 0);
  EXPECT_NE(
      check.output.find("world.sdf:2:32: warning: model `m` is left out: <pose>: `1 2` has 2 numbers, and needs 6 "
                        "separated by blanks\n"),
      std::string::npos)
      << check.output;
}

TEST(WorldFileOfAScenario, RandomPlacesKeepClearOfItsSceneryAndRobots) {
  // only the right part of the area is free of the house (-4.5 to -3.5)
  const WorldFile file(house +
                           "<model name='slab'><static>true</static><pose>0 0 -0.5 0 0 0</pose><link "
                           "name='l'><collision name='c'><geometry><box>"
                           "<size>50 50 1</size></box></geometry></collision></link></model>",
                       "world: {file: world.sdf, places: {strip: [{center: [-3.5, 0], size: [2, 0.2]}]}}\n"
                       "robots: {balls: {shape: {sphere: 0.2}, mass: 1, count: 1, place: {random: strip}, motion: "
                       "{use: motion.point}}}\n");
  for (int seed = 1; seed <= 20; ++seed) {
    const BuiltScenario built = file.open({"seed=" + std::to_string(seed)});
    EXPECT_GT(built.simulation->world().value("balls_0/body", keys::pose).position.x(), -3.5 + 0.2 + 0.1 - 1e-9);
  }
}

struct Wrong {
  const char* world;
  const char* scenario;
  const char* message;
};

TEST(WorldFileOfAScenario, ThatDoesNotExistIsToldWithItsFolderAndTheNearestName) {
  const WorldFile file("", "world: {file: wrld.sdf}\n");
  const auto result = file.check();
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_TRUE(result.output.starts_with("s.yaml:1:15: world wrld.sdf does not exist in /")) << result.output;
  EXPECT_TRUE(result.output.ends_with(" (did you mean `world.sdf`?)\n")) << result.output;
}

TEST(WorldFileOfAScenario, MistakesAreOneMessageWithThePlaceAndExitCode2) {
  const Wrong all[] = {
      {"", "world: {file: " MURO_TEST_SOURCE_DIR "/examples/models/rover.urdf}\n",
       "s.yaml:1:15: world " MURO_TEST_SOURCE_DIR "/examples/models/rover.urdf: " MURO_TEST_SOURCE_DIR
       "/examples/models/rover.urdf describes a robot, not a world; name it as the `model` of a robot\n"},
      {"", "world: {file: s.yaml}\n",
       "s.yaml:1:15: no reader for models of type `.yaml` (s.yaml); known types: .png, .jpg, .jpeg, .tif, .tiff, .r32, "
       ".f32, .raw, .bin, "
       ".hfield, .stl, .obj, .dae, .glb, .gltf, .ply, "
       ".xml, "
       ".mjcf, .sdf, .world, .urdf, .xacro\n"},
      {"<gravity>down</gravity>", "world: {file: world.sdf}\n",
       "s.yaml:1:15: world world.sdf:2:1: <gravity>: `down` is no number; write it like 0.05 or 5e-2\n"},
      {"<model name='m'><static>1</static><link name='a'/></model>",
       "world: {file: world.sdf}\nrobots: {m: {model: world}}\n",
       "s.yaml:2:21: robot `m`: the world file world.sdf has no movable model of this name; all of its models are "
       "static\n"},
      {"<model name='cart'><link name='a'/></model>", "world: {file: world.sdf}\nrobots: {card: {model: world}}\n",
       "s.yaml:2:24: robot `card`: the world file world.sdf has no movable model of this name (did you mean `cart`?); "
       "it has: cart\n"},
      {"", "robots: {m: {model: world}}\n",
       "s.yaml:1:21: robot `m`: `model: world` takes a model of the world file, but there is no `world: {file: "
       "...}`\n"},
      {"<model name='m'><link name='a'/></model>",
       "world: {file: world.sdf}\nrobots: {m: {model: world, at: {x: 1}, count: 2}}\n",
       "s.yaml:2:47: `count` of robot `m` is not allowed with `model: world`: the world file states the pose of the "
       "model\n"
       "s.yaml:2:32: `at` of robot `m` is not allowed with `model: world`: the world file states the pose of the "
       "model\n"},
      {"", "robots: {m: {model: world.sdf}}\n",
       "s.yaml:1:21: robot `m`: model world.sdf:1:1: the file holds no <model>; it describes a world: name it under "
       "`world: {file: ...}`\n"},
      {"<model name='m'><static>1</static><link name='a'><collision "
       "name='c'><geometry><sphere><radius>1</radius></sphere></geometry></collision></link></model>",
       "world: {file: world.sdf, objects: {m: {shape: plane}}}\n",
       "s.yaml:1:39: two objects are named `m`; names are unique\n"},
  };
  for (const Wrong& w : all) {
    const WorldFile file(w.world, w.scenario);
    const auto result = file.check();
    EXPECT_EQ(result.output, w.message) << w.scenario;
    EXPECT_EQ(result.exit_code, 2) << w.scenario;
  }
}

}  // namespace
}  // namespace muro::host
