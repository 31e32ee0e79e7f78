// SPDX-License-Identifier: MIT
// Robots of other lengths, masses, servos and joints walk by other numbers alone.
#include <gtest/gtest.h>

#include <regex>

#include "generated_humanoid_testing.hpp"
#include "tests/support/files.hpp"
#include "walk_testing.hpp"

namespace muro::walk_test {
namespace {

/// Checks the way of 5 s, after 3.5 s in which the robot gets ready and takes its first steps.
void expect_walk(const Numbers& n, const std::string& motion, const std::string& tunables, double speed) {
  SCOPED_TRACE(motion);
  const test::ScratchFolder folder;
  Walker walker({}, scenario_of(folder, n, motion, tunables));
  walker.run(3.5);
  const Vec3 before = walker.pose().position;
  walker.run(5);
  const Vec3 way = walker.pose().position - before;
  EXPECT_NEAR(way.x(), 5 * speed, 0.3 * 5 * speed);
  EXPECT_LT(std::abs(way.y()), 0.1);
  EXPECT_GT(walker.least_upright(), 0.99);
  EXPECT_GT(walker.least_height(), 0.95 * before.z());
  EXPECT_EQ(walker.touched(), "");
  EXPECT_GT(walker.feet_down()[1], 250) << "feet leave the ground";
}

TEST(OtherRobots, OneLikeOp2WithMirroredJointsWalks) {
  for (const char* motion : {"motion.articulated", "motion.mujoco"}) expect_walk(op2(), motion, "forward=0.1", 0.1);
}

TEST(OtherRobots, OneLikeSigmabanWithOtherZerosWalks) {
  for (const char* motion : {"motion.articulated", "motion.mujoco"})
    expect_walk(sigmaban(), motion,
                "forward=0.15, period=0.4, rise=0.03, step_forward=0.12, "
                "ankle_pitch_rate=0.03, ankle_roll_rate=0.03, capture=0.4",
                0.15);
}

/// The simpler humanoid of examples/models, whose drives are as hard as the motion makes them.
TEST(OtherRobots, TheBipedOfTheModelsWalks) {
  std::string joints;
  for (const std::string side : {"left", "right"})
    for (const char* name : {"hip_yaw", "hip_roll", "hip_pitch", "knee", "ankle_pitch", "ankle_roll"})
      joints += (joints.empty() ? "" : ",") + side + "_" + name + ":joint.position";
  const std::string targets = std::regex_replace(joints, std::regex("position"), "position.target");
  const test::ScratchFolder folder;
  const std::string text = R"(world: {objects: {ground: {shape: plane, friction: 0.9}}}
robots:
  walker:
    model: )" MURO_TEST_SOURCE_DIR R"(/examples/models/biped.urdf
    motion: {use: motion.articulated, rate: 1000, joints: position, interpolate: 0.008}
    imu: {use: sensor.imu, on: torso, rate: 125}
    imu_error: {use: sensor.error, on: imu, part: mti1}
    walk:
      use: controller.library
      library: walk
      rate: 125
      inputs: ["joint.position=)" +
                           joints + "\"]\n      outputs: [\"joint.position.target=" + targets + R"("]
      tunables: [hip_y=0.04, hip_z=-0.05, hip_pitch_x=0, thigh=0.12, shin=0.12, sole_x=0.015, sole_y=0.005,
                 sole_z=0.03, mass=4.06, leg_mass=0.192, leg_com=0.465, upper_com_x=0, upper_com_z=0.0962,
                 trunk_height=0.3, stiffness=0, ankle_pitch_rate=0.03, ankle_roll_rate=0.03]
)";
  Walker walker({}, folder.file("biped.yaml", text));
  walker.run(8);
  EXPECT_NEAR(walker.pose().position.x(), 0.1 * 5.4, 0.1);
  EXPECT_LT(std::abs(walker.pose().position.y()), 0.05);
  EXPECT_GT(walker.least_upright(), 0.998);
  EXPECT_EQ(walker.touched(), "");
}

/// The humanoid with one drive for both hip yaws, like NAO: the right joint follows the left one.
TEST(OtherRobots, OneWhoseHipYawsTurnTogetherWalks) {
  const std::string models = MURO_TEST_SOURCE_DIR "/examples/models/";
  std::string model = test::text_of(models + "humanoid.urdf");
  model = std::regex_replace(model, std::regex("\"meshes/"), "\"" + models + "meshes/");
  const std::string joint = "<joint name=\"r_hip_yaw\" type=\"revolute\">";
  ASSERT_NE(model.find(joint), model.npos);
  model.insert(model.find(joint) + joint.size(), "<mimic joint=\"l_hip_yaw\" multiplier=\"-1\"/>");
  const test::ScratchFolder folder;
  const std::string file = folder.file("coupled.urdf", model);
  for (const char* motion : {"articulated", "mujoco", "biped"}) {
    SCOPED_TRACE(motion);
    Walker walker({"robots.walker.model=" + file, std::string("robots.walker.motion.use=motion.") + motion,
                   tunables("forward=0.1, heading=0")});
    walker.run(8);
    EXPECT_NEAR(walker.pose().position.x(), 0.1 * 5.4, 0.15);
    EXPECT_GT(walker.least_upright(), 0.99);
    EXPECT_GT(walker.least_height(), 0.24);
    EXPECT_EQ(walker.phase(), 2);
    EXPECT_NEAR(walker.world().value("walker/r_hip_yaw", keys::joint_position),
                -walker.world().value("walker/l_hip_yaw", keys::joint_position), 1e-4);
  }
}

}  // namespace
}  // namespace muro::walk_test
