// SPDX-License-Identifier: MIT
// controller.library in real simulations, with the control code of test_controllers/.
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>

#include "muro_controller.h"
#include "tests/support/scene.hpp"

namespace muro {
namespace {

using Texts = std::vector<std::string>;
using Settings = std::map<std::string, ParameterInput>;

const std::string folder = CONTROLLERS "/";

RobotTree two_arms() {
  return test::tree_of([](RobotBuilder& b) {
    b.base("body");
    b.set(keys::inertial, {.mass = 1, .ixx = 1, .iyy = 1, .izz = 1});
    b.fork();
    b.revolute("left", Vec3::UnitZ(), {});
    b.body("left_arm");
    b.end();
    b.revolute("right", Vec3::UnitZ(), {});
    b.body("right_arm");
    b.end();
  });
}

/// Two robots "a" and "b" that go as commanded, at 20 Hz.
struct Team : test::Scene {
  explicit Team(std::uint64_t seed = 1) : Scene(seed) {
    const RobotTree tree = two_arms();
    a = &add("a", tree);
    b = &add("b", tree, {{4, 0, 0}, Quat::Identity()});
    use("motion.point", 20, all_robots());
  }
  void control(const std::string& library, Settings settings = {}) {
    control_by(library, all_robots(), std::move(settings));
  }
  void control_by(const std::string& library, std::vector<Item> items, Settings settings = {}) {
    settings["library"] = library;
    use("controller.library", 10, std::move(items), std::move(settings));
  }
  Twist& command(const RobotView& r) { return world().value(r.base(), keys::command_twist); }

  const RobotView* a = nullptr;
  const RobotView* b = nullptr;
};

/// A robot with a scanner: an object `laser` with constant readings.
struct Seeing : Team {
  Seeing() {
    laser = add_sensor("laser", {1, 2, 3, 4});
    world().set(laser, keys::laser_columns, 4u);
  }
  ObjectId add_sensor(const std::string& name, const std::vector<double>& ranges) {
    const ObjectId sensor = add_sensor_object(*a, name, a->base());
    world().set_array(sensor, keys::ranges, std::span<const double>(ranges));
    world().set(sensor, keys::laser_min_angle, 0.5);
    return sensor;
  }
  void see(Settings settings = {}) {
    if (!settings.contains("inputs")) settings["inputs"] = Texts{"angle=laser.min_angle"};
    control_by(folder + "see.so", {{a, a->base()}}, std::move(settings));
  }
  ObjectId laser = no_object;
};

/// The message with which building fails.
template <class S>
std::string refusal(S& s) {
  try {
    s.build();
  } catch (const SetupError& e) {
    return e.what();
  }
  return "it was accepted";
}

std::string refusal_of(const std::string& library, Settings settings = {}) {
  Team team;
  team.control(folder + library, std::move(settings));
  return refusal(team);
}

std::string failure(Simulation& s, double seconds) {
  try {
    s.run_for(seconds);
  } catch (const StepError& e) {
    return e.what();
  }
  return "it went well";
}

::testing::AssertionResult says(const std::string& text, const std::string& part) {
  if (text.find(part) != std::string::npos) return ::testing::AssertionSuccess();
  return ::testing::AssertionFailure() << text << "\nlacks\n" << part;
}

TEST(ControllerLibrary, SteersEachRobotWithAStateOfItsOwn) {
  Team team;
  team.control(folder + "circle.so");
  team.build();
  team.run_for(0.3);
  const double va = team.command(*team.a).linear.x(), vb = team.command(*team.b).linear.x();
  EXPECT_GT(va, 0.1);
  EXPECT_NE(va, vb) << "seeds differ between robots";
  EXPECT_NEAR(team.twist(*team.a).linear.norm(), va, 1e-12);
  EXPECT_EQ(team.command(*team.a).angular.z(), 1) << "in the first seven steps";
  team.run_for(0.5);
  EXPECT_EQ(team.command(*team.a).angular.z(), -1) << "the state counts steps";
}

TEST(ControllerLibrary, TakesItsChancesFromTheSeedOfTheSimulation) {
  const auto speed = [](std::uint64_t seed) {
    Team team(seed);
    team.control(folder + "circle.so");
    team.build();
    team.run_for(0.1);
    return team.command(*team.a).linear.x();
  };
  EXPECT_EQ(speed(1), speed(1));
  EXPECT_NE(speed(1), speed(2));
}

TEST(ControllerLibrary, BeginsAnewAfterAResetToTheBit) {
  Team team;
  team.control(folder + "circle.so");
  team.build();
  team.run_for(2.3);
  const std::uint64_t end = team.state_hash();
  team.reset();
  team.run_for(1.1);
  EXPECT_NE(team.state_hash(), end);
  team.run_for(1.2);
  EXPECT_EQ(team.state_hash(), end);
}

TEST(ControllerLibrary, GoesOnFromASnapshotToTheSameBits) {
  Team team;
  team.control(folder + "circle.so");
  team.build();
  const Snapshot start = team.snapshot();
  team.run_for(0.9);
  const Snapshot middle = team.snapshot();
  team.run_for(1.4);
  const std::uint64_t end = team.state_hash();
  team.restore(middle);
  team.run_for(1.4);
  EXPECT_EQ(team.state_hash(), end);
  team.restore(start);
  team.run_for(2.3);
  EXPECT_EQ(team.state_hash(), end);
}

TEST(ControllerLibrary, ReadsTheOnlyObjectThatHasAPropertyAndConvertsIt) {
  Seeing s;
  s.see();
  s.build();
  s.run_for(0.1);
  const Twist& seen = s.command(*s.a);
  EXPECT_EQ(seen.linear, Vec3(1, 4, 4)) << "first range, last range, columns (a whole number)";
  EXPECT_EQ(seen.angular.x(), 0.5);
}

TEST(ControllerLibrary, PrefersTheReadingOfTheDeviceToTheTrueOne) {
  const Key<double> measured{"ranges.measured", "m", "as the device reports it"};
  const std::vector<double> readings{1.5, 2.5, 3.5};
  for (const auto& [connection, first] : {std::pair{"", 1.5}, {"ranges=ranges", 1.0}, {"ranges=laser:ranges", 1.0}}) {
    Seeing s;
    s.world().set_array(s.laser, measured, std::span<const double>(readings));
    Texts inputs{"angle=laser.min_angle"};
    if (*connection) inputs.push_back(connection);
    s.see({{"inputs", inputs}});
    s.build();
    s.run_for(0.1);
    EXPECT_EQ(s.command(*s.a).linear.x(), first) << connection;
  }
}

TEST(ControllerLibrary, AsksWhichObjectIsMeantWhenSeveralHaveAProperty) {
  Seeing s;
  s.add_sensor("rear", {7, 8});
  s.see();
  EXPECT_TRUE(says(
      refusal(s),
      "robot `a`: input `ranges` of `see` cannot be connected: several objects of robot `a` have a property `ranges`: "
      "laser, rear; choose in `inputs`, e.g. \"ranges=laser:ranges\""));
  Seeing chosen;
  chosen.add_sensor("rear", {7, 8});
  chosen.see({{"inputs", Texts{"ranges=rear:ranges", "angle=rear:laser.min_angle"}}});
  chosen.build();
  chosen.run_for(0.1);
  EXPECT_EQ(chosen.command(*chosen.a).linear.head<2>(), Eigen::Vector2d(7, 8));
}

TEST(ControllerLibrary, PrefersTheObjectItIsOn) {
  Seeing s;
  const ObjectId rear = s.add_sensor("rear", {7, 8});
  s.control_by(folder + "see.so", {{s.a, rear}}, {{"inputs", Texts{"angle=laser.min_angle"}}});
  s.build();
  s.run_for(0.1);
  EXPECT_EQ(s.command(*s.a).linear, Vec3(7, 8, 4)) << "the columns are those of the only object that has them";
}

TEST(ControllerLibrary, SetsSeveralPropertiesSideBySide) {
  Seeing s;
  const ObjectId left = s.world().object("a/left"), right = s.world().object("a/right");
  s.world().set(left, keys::joint_position, 0.25);
  s.world().set(right, keys::joint_position, -0.75);
  s.see({{"inputs", Texts{"angle=laser.min_angle", "ranges=left:joint.position,right:joint.position"}}});
  EXPECT_TRUE(says(refusal(s), "`a/left:joint.position` is in \"rad or m\", but the library works in \"m\""));

  Team team;
  team.control_by(folder + "team.so", {},
                  {{"inputs", Texts{"poses=a/body:pose,b/body:pose"}},
                   {"outputs", Texts{"commands=a/body:command.twist,b/body:command.twist"}}});
  team.build();
  team.run_for(0.1);
  EXPECT_EQ(team.command(*team.a).linear.x(), 4);
  EXPECT_EQ(team.command(*team.b).linear.x(), -4);
  team.run_for(9.9);
  EXPECT_NEAR(team.pose(*team.a).position.x(), 2, 1e-6);
  EXPECT_NEAR(team.pose(*team.b).position.x(), 2, 1e-6);
}

TEST(ControllerLibrary, AJointPropertyOfManyJointsNeedsAChoice) {
  Seeing s;
  s.world().set(s.world().object("a/left"), keys::joint_position, 0.25);
  s.world().set(s.world().object("a/right"), keys::joint_position, -0.75);
  s.see({{"inputs", Texts{"angle=joint.position"}}});
  EXPECT_TRUE(
      says(refusal(s),
           "several objects of robot `a` have a property `joint.position`: left, right; choose in `inputs`, e.g. "
           "\"angle=left:joint.position\" (several, separated by commas, stand side by side)"));
}

TEST(ControllerLibrary, LetsTwoLibrariesOrTwiceTheSameServeOneRobot) {
  Team team;
  team.control_by(folder + "circle.so", {{team.a, team.a->base()}}, {{"arguments", Texts{"name=first"}}});
  team.control_by(folder + "circle.so", {{team.a, team.a->base()}},
                  {{"arguments", Texts{"name=second"}}, {"outputs", Texts{"command.twist=b/body:command.twist"}}});
  team.build();
  team.run_for(1);
  EXPECT_GT(team.command(*team.a).linear.x(), 0.1);
  EXPECT_GT(team.command(*team.b).linear.x(), 0.1);
}

TEST(ControllerLibrary, EndsTheRunWithTheLibrarysReasonAndTheRobotsName) {
  Team team;
  team.control(folder + "circle.so", {{"arguments", Texts{"fail_at=5"}}});
  team.build();
  const std::string said = failure(team, 2);
  EXPECT_TRUE(says(said, "failed at t = 0.5"));
  EXPECT_TRUE(says(said, "robot `a`: `circle` fails: lost at x = "));
  EXPECT_TRUE(says(said, " after 0.50 s"));
}

TEST(ControllerLibrary, EndsTheRunWhenAnOutputIsNoFiniteNumber) {
  Team team;
  team.control(folder + "circle.so", {{"arguments", Texts{"nan_at=3"}}});
  team.build();
  EXPECT_TRUE(says(failure(team, 2),
                   "robot `a`: output `command.twist` of `circle`[5] is nan; outputs must be finite numbers"));
}

TEST(ControllerLibrary, HandsOverNamePeriodSizesAndArguments) {
  const auto failure_with = [](const std::string& argument) {
    Team team;
    team.control(folder + "circle.so", {{"arguments", Texts{"other=1", argument}}});
    team.build();
    return failure(team, 1);
  };
  EXPECT_TRUE(says(failure_with("tell=all"), "robot `a`: `circle` fails: robot a, period 0.1, sizes 7"));
  EXPECT_TRUE(says(failure_with("tell=nothing"), "robot `a`: `circle` fails without giving a reason"));
  EXPECT_TRUE(says(failure_with("tell=endless"), "`circle` fails: xxxxxxxx"));
}

TEST(ControllerLibrary, FindsALibraryByItsNameOnThePath) {
  Team missing;
  missing.control("circle");
  const std::string said = refusal(missing);
  EXPECT_TRUE(says(said, "no library `circle.so` or `libcircle.so` in any of these folders: " +
                             std::filesystem::current_path().string()));
  EXPECT_TRUE(
      says(said, MURO_TEST_PLUGIN_DIR "/controllers; give its path, or add its folder to MURO_CONTROLLER_PATH"));

  ASSERT_EQ(setenv("MURO_CONTROLLER_PATH", ("/nowhere::" + folder).c_str(), 1), 0);
  for (const char* name : {"circle", "circle.so"}) {
    Team team;
    team.control(name);
    EXPECT_NO_THROW(team.build()) << name;
  }
  Team prefixed;
  prefixed.control("prefixed");
  EXPECT_NO_THROW(prefixed.build());
  Team wrong;
  wrong.control("circel");
  EXPECT_TRUE(says(refusal(wrong), ", /nowhere, " + folder + ", "));
  unsetenv("MURO_CONTROLLER_PATH");
}

TEST(ControllerLibrary, TakesPathsRelativeToTheScenario) {
  Team team;
  AlgorithmSetup setup;
  setup.use = "controller.library";
  setup.rate = Rate(10);
  setup.items = team.all_robots();
  setup.folder = std::filesystem::path(folder).parent_path().parent_path().string();
  setup.parameters["library"] = std::string("controllers/circle.so");
  team.Simulation::add(setup);
  EXPECT_NO_THROW(team.build());
  Team wrong;
  setup.items = wrong.all_robots();
  setup.parameters["library"] = std::string("controllers/circel.so");
  wrong.Simulation::add(setup);
  EXPECT_TRUE(says(refusal(wrong), "there is no library `" + setup.folder + "/controllers/circel.so`"));
}

TEST(ControllerLibrary, HasItsOwnStepWhereTheCLibraryHasOneToo) {
  Team team;
  team.control(folder + "bound_step.so");
  team.build();
  EXPECT_NO_THROW(team.run_for(1));
}

#ifdef FORTRAN_CONTROLLER
TEST(ControllerLibrary, MayBeWrittenInFortran) {
  Team team;
  team.control(FORTRAN_CONTROLLER);
  team.build();
  team.run_for(1);
  EXPECT_EQ(team.command(*team.a).linear.x(), 0.5);
}
#endif

TEST(ControllerLibrary, ThatWasCopiedByHalfIsRefused) {
  const std::string half = testing::TempDir() + "half.so";
  std::filesystem::copy_file(folder + "circle.so", half, std::filesystem::copy_options::overwrite_existing);
  std::filesystem::resize_file(half, 5000);
  Team team;
  team.control(half);
  const std::string said = refusal(team);
  EXPECT_NE(said.find("library " + half + " cannot be loaded: the file has 5000 bytes and should have at "),
            std::string::npos)
      << said;
}

TEST(ControllerLibrary, NamesWhatIsWrongWithALibrary) {
  for (const auto& [library, message] : {
           std::pair<std::string, std::string>{"no_symbol.so", "exports no `muro_controller`"},
           {"unresolved.so", "cannot be loaded: undefined symbol: function_of_no_library"},
           {"open_step.so", "would use functions of others in place of its own: `step` (of "},
           {"no_table.so", "`muro_controller` returns no table"},
           {"other_abi.so", "abi is 7, this muro has 1; build it with the muro_controller.h of this muro"},
           {"other_size.so",
            "table_size is 8, this muro has " + std::to_string(sizeof(muro_controller_table)) + "; build it"},
           {"no_name.so", "its table has no name"},
           {"no_step.so", "its table has no function `step`"},
           {"huge_state.so", "state_size is 1099511627776 bytes; at most 2147483647 are allowed"},
           {"no_inputs.so", "has 2 inputs, but its table points to none"},
           {"nameless_input.so", "input 1 has no name"},
           {"same_inputs.so", "has two inputs named `pose`; names are unique"},
           {"open_output.so", "output `command.twist` has size 0; only inputs may leave their size open"},
           {"unknown_output.so",
            "output `comand.twist` of `one` cannot be connected: no object of robot `a` has a property "
            "`comand.twist` (did you mean `command.twist`?); its objects have: "},
           {"wrong_unit.so", "`a/body:command.twist` is in \"m/s, rad/s\", but the library works in \"km/h\""},
           {"wrong_size.so",
            "robot `a`: output `command.twist` of `one` has 2 numbers in the library, but the connected properties "
            "have 6"},
       })
    EXPECT_TRUE(says(refusal_of(library), message));
}

TEST(ControllerLibrary, NamesWhatIsWrongWithAConnection) {
  const auto refused = [](const std::string& input) { return refusal_of("circle.so", {{"inputs", Texts{input}}}); };
  EXPECT_TRUE(says(refused("pos=twist"),
                   "`inputs`: `pos=twist`: library `circle` has no such input (did you mean `pose`?); it has: pose"));
  EXPECT_TRUE(says(refused("pose"), "`inputs`: `pose` must be \"port=object:property\" or \"port=property\""));
  EXPECT_TRUE(says(refused("pose="), "`inputs`: `pose=` names no property"));
  EXPECT_TRUE(says(refused("pose=body:"), "names no property"));
  EXPECT_TRUE(says(refused("pose=bdy:pose"), "robot `a` has no object `bdy` (did you mean `body`?); it has: body, "));
  EXPECT_TRUE(
      says(refused("pose=body:psoe"), "object `a/body` has no property `psoe` (did you mean `pose`?); it has: "));
  EXPECT_TRUE(says(refused("pose=body:collision.shapes"), "has no property `collision.shapes`"));
  EXPECT_TRUE(says(refusal_of("circle.so", {{"inputs", Texts{"pose=body:pose", "pose=b/body:pose"}}}),
                   "connects port `pose` a second time"));
  EXPECT_TRUE(
      says(refusal_of("circle.so", {{"arguments", Texts{"fast"}}}), "`arguments`: `fast` must be \"name=value\""));
  Team team;
  const std::vector<Shape> shapes{Shape::sphere(1)};
  team.world().set_array(team.a->base(), keys::collision_shapes, std::span<const Shape>(shapes));
  team.control(folder + "circle.so", {{"inputs", Texts{"pose=collision.shapes"}}});
  EXPECT_TRUE(says(refusal(team), "`a/body:collision.shapes` is of type muro.Shape, which is not made of numbers"));
}

TEST(ControllerLibrary, ALibraryBuiltWithFastMathChangesNobodysArithmetic) {
  const volatile double smallest_normal = std::numeric_limits<double>::min();
  Team team;
  team.control(folder + "fast_math.so");
  team.build();
  EXPECT_GT(smallest_normal / 2, 0) << "subnormal numbers are still there";
}

}  // namespace
}  // namespace muro
