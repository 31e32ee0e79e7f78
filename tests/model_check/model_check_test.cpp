// SPDX-License-Identifier: MIT
// Output of `muro check` about models.
#include <gtest/gtest.h>

#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"

namespace muro::host {
namespace {

const std::string muro_program = std::string("MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " ") + MURO_PROGRAM;

/// Returns a chain of `joints` joints; `of_link`: content of each of its links.
std::string chain(int joints, const std::string& of_link, const std::string& limit = "lower='-2' upper='2'") {
  std::string urdf = "<robot name='chain'><link name='base'/>";
  for (int i = 0; i < joints; ++i) {
    const std::string n = std::to_string(i), parent = i == 0 ? "base" : "link_" + std::to_string(i - 1);
    urdf += "<link name='link_" + n + "'>" + of_link + "</link><joint name='joint_" + n +
            "' type='revolute'><parent link='" + parent + "'/><child link='link_" + n +
            "'/><axis xyz='0 1 0'/><origin xyz='0 0 0.2'/><limit velocity='1' effort='5' " + limit + "/></joint>\n";
  }
  return urdf + "</robot>";
}

constexpr const char* mass =
    "<inertial><mass value='1'/><inertia ixx='0.01' iyy='0.01' izz='0.01' ixy='0' ixz='0' "
    "iyz='0'/></inertial>";
constexpr const char* shape = "<collision><geometry><sphere radius='0.05'/></geometry></collision>";

struct Check {
  test::ScratchFolder folder;

  /// Returns its output, with warnings and notes.
  std::string of(const std::string& robots, const std::string& arguments = "", int exit_code = 0) const {
    const std::string file = folder.file("s.yaml", "world: {objects: {ground: {shape: plane}}}\nrobots:\n" + robots);
    const auto result = test::run_command(muro_program + " check " + file + " " + arguments);
    EXPECT_EQ(result.exit_code, exit_code) << result.output;
    return result.output;
  }
};

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t n = 0;
  for (std::size_t at = text.find(part); at != text.npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(ModelCheck, TellsOnceOfARobotThatNoForceCanMove) {
  const Check check;
  check.folder.file("arm.urdf", chain(6, shape));
  const std::string said = check.of(
      "  arms: {model: arm.urdf, motion: {use: motion.simplified, base: fixed}, place: {grid: {count: [6, 2], spacing: "
      "[2, 2]}}}\n");
  EXPECT_SAYS(said,
              "`arms` (12 robots), arm.urdf: 7 links, 6 joints, 0 kg; motion.simplified\n  - no link that moves has "
              "mass: 6 links (`link_0`, `link_1`, `link_2` and 3 more);\n      motion.simplified: joints follow "
              "targets of position or velocity within limits, without forces\n      For forces, give the links mass "
              "and inertia: "
              "`<inertial>`.\n");
  EXPECT_EQ(count_of(said, "has mass"), 1u) << said;
  EXPECT_EQ(count_of(said, "has a mass"), 0u) << said;
}

TEST(ModelCheck, TellsTogetherWhatIsTheSameAtSeveralLevels) {
  const Check check;
  check.folder.file("arm.urdf", chain(2, ""));
  const std::string said = check.of(
      "  arm: {model: arm.urdf, motion: {levels: {a: {use: motion.point}, b: {use: motion.simplified, base: "
      "fixed}, c: {use: motion.simplified, base: fixed, joints: position}}}}\n");
  EXPECT_SAYS(said,
              "no link has a shape for collision;\n      motion.point: nothing meets it;\n      motion.simplified: "
              "nothing meets it, and it meets nothing\n");
  EXPECT_EQ(count_of(said, "no link that moves has mass"), 1u) << said;
}

TEST(ModelCheck, TellsOfARobotThatNothingCanTouch) {
  const Check check;
  check.folder.file("arm.urdf", chain(2, mass));
  const std::string said = check.of("  r: {model: arm.urdf, motion: {use: motion.simplified}}\n");
  EXPECT_SAYS(said, "no link has a shape for collision");
  EXPECT_SAYS(said, "it falls through the ground");
  check.folder.file("arm.urdf", chain(2, std::string(mass) + shape));
  EXPECT_SAYS(check.of("  r: {model: arm.urdf, motion: {use: motion.point}}\n"),
              "\n  - motion.point: forces and contacts do not move it");
}

TEST(ModelCheck, SaysOfASoundModelThatNothingIsLacking) {
  const Check check;
  EXPECT_SAYS(
      check.of("  r: {model: " MURO_TEST_SOURCE_DIR
               "/examples/models/rover.urdf, motion: {use: motion.simplified}, drive: {use: drive.skid_steer}}\n"),
      "`r`: nothing is lacking\n");
}

TEST(ModelCheck, TellsOfDrivesWithoutLimits) {
  const Check check;
  std::string wheels = "<robot name='cart'><link name='base'>" + std::string(mass) + shape + "</link>";
  for (const char* side : {"left", "right"})
    wheels += std::string("<link name='") + side + "_wheel'>" + mass +
              "<collision><origin rpy='1.5708 0 0'/><geometry><cylinder radius='0.1' length='0.02'/></geometry>"
              "</collision></link><joint name='" +
              side + "' type='continuous'><parent link='base'/><child link='" + side + "_wheel'/><origin xyz='0 " +
              (side[0] == 'l' ? "0.2" : "-0.2") + " 0'/><axis xyz='0 1 0'/></joint>";
  check.folder.file("cart.urdf", wheels + "</robot>");
  const std::string robot = "  cart: {model: cart.urdf, motion: {use: motion.simplified}";
  EXPECT_SAYS(
      check.of(robot + ", drive: {use: drive.differential}}\n"),
      "2 driven joints (`left`, `right`) without a limit of effort;\n      motion.simplified: drives are as strong as "
      "it takes\n");
  EXPECT_SAYS(check.of("  cart: {model: cart.urdf, motion: {use: motion.simplified, joints: velocity}}\n"),
              "`cart`: nothing is lacking");
}

TEST(ModelCheck, TellsOfJointsThatNothingCommands) {
  const Check check;
  const std::string car = "  car: {model: " MURO_TEST_SOURCE_DIR "/examples/models/car.urdf, motion: {use: motion.";
  EXPECT_SAYS(
      check.of(car + "simplified}}\n"),
      "nothing commands 6 joints (`rear_left_wheel_joint`, `rear_right_wheel_joint`, "
      "`front_left_steering_joint` and 3 more);\n      motion.simplified: held at speed 0, as a program outside "
      "may command them\n      `joints: passive` lets them turn freely");
  EXPECT_SAYS(check.of(car + "articulated}, drive: {use: drive.ackermann}}\n"), "`car`: nothing is lacking");
  EXPECT_SAYS(
      check.of(car + "articulated}, drive: {use: drive.differential, left: [rear_left_wheel_joint], "
                     "right: [rear_right_wheel_joint]}}\n"),
      "nothing commands 2 joints (`front_left_steering_joint`, `front_right_steering_joint`), but others of the "
      "robot;\n      motion.articulated: they turn freely\n      To hold them, name them in");
}

TEST(ModelCheck, TakesAScreenForTheWorstOfModels) {
  const Check check;
  std::string robots;
  for (int i = 0; i < 100; ++i) {  // each lacks something else
    const std::string n = std::to_string(i);
    check.folder.file("r" + n + ".urdf", chain(50 - i % 7, "", "lower='0.1' upper='0.1'"));
    robots += "  r" + n + ": {model: r" + n + ".urdf, at: {x: " + std::to_string(100 * i) +
              "}, motion: {use: motion.point}}\n";
  }
  const std::string said = check.of(robots);
  EXPECT_LE(count_of(said, "\n"), 45u) << said;
  EXPECT_SAYS(said, "`muro check --full` tells what");
  EXPECT_GT(count_of(check.of(robots, "--full"), "\n"), 200u);
}

TEST(ModelCheck, TellsHowEveryMotionWouldServeARobot) {
  const Check check;
  check.folder.file("arm.urdf", chain(3, shape));
  const std::string said = check.of("  arm: {model: arm.urdf, motion: {use: motion.point}}\n", "--levels");
  EXPECT_SAYS(said, "`arm` with each motion:\n");
  EXPECT_SAYS(said, "motion.point");
  EXPECT_SAYS(said, "refuses it: `arm` has no mass; give its bodies mass and inertia");
  const std::string fixed =
      check.of("  arm: {model: arm.urdf, motion: {use: motion.simplified, base: fixed}}\n", "--levels");
  EXPECT_SAYS(fixed, "motion.simplified         takes it as it is\n");
}

TEST(ModelCheck, RefusesWithStrictWhatItElseTells) {
  const Check check;
  check.folder.file("arm.urdf", chain(2, std::string(mass) + shape, "lower='0.5' upper='1'"));
  const std::string robots = "  r: {model: arm.urdf, motion: {use: motion.simplified, base: fixed}}\n";
  const std::string said = check.of(robots);
  EXPECT_SAYS(said, "2 joints (`joint_0`, `joint_1`) cannot be at 0 at the start; the nearest limit is taken\n");
  EXPECT_EQ(count_of(said, "cannot be at 0"), 1u) << said;
  EXPECT_SAYS(check.of(robots, "--strict", 2), "--strict lets no joint start at a limit unasked");
}

}  // namespace
}  // namespace muro::host
