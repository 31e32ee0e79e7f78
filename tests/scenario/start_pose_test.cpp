// SPDX-License-Identifier: MIT
// Joints at the start, and the placement of a robot in that pose.
#include <gtest/gtest.h>

#include <cmath>

#include "core/error.hpp"
#include "host/scenario/builder.hpp"
#include "host/scenario/features/unsupported_features.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

/// Returns a box with a height of 0.2 m, and a boom of 1 m along x that turns down with rising angles and ends in a
/// ball of 0.1 m. A flag on the box follows the boom.
std::string crane(const std::string& limits) {
  const std::string inertial =
      R"(<inertial><mass value="1"/><inertia ixx="0.1" iyy="0.1" izz="0.1" ixy="0" ixz="0" iyz="0"/></inertial>)";
  return R"(<robot name="crane"><link name="box">)" + inertial +
         R"(<collision><geometry><box size="0.2 0.2 0.2"/></geometry></collision></link>
<link name="boom">)" +
         inertial + R"(<collision><origin xyz="1 0 0"/><geometry><sphere radius="0.1"/></geometry></collision></link>
<link name="flag"/>
<joint name="lift" type="revolute"><parent link="box"/><child link="boom"/><axis xyz="0 1 0"/>)" +
         limits + R"(</joint>
<joint name="wave" type="continuous"><parent link="box"/><child link="flag"/><axis xyz="0 1 0"/>
<mimic joint="lift" multiplier="2" offset="0.25"/></joint>
</robot>)";
}
const std::string above_zero = R"(<limit lower="0.5" upper="1.25" effort="10" velocity="1"/>)";
const std::string about_zero = R"(<limit lower="-1" upper="1" effort="10" velocity="1"/>)";

class ARobotWithAJoint : public testing::Test {
 protected:
  BuiltScenario built(const std::string& limits, const std::string& more = "", const std::string& place = "") {
    folder_.file("crane.urdf", crane(limits));
    return build(
        read_scenario(folder_.file("crane.yaml", "robots:\n  crane: {model: crane.urdf" + more + place + "}\n"), {}),
        test::plugins());
  }
  static double height(const BuiltScenario& b) {
    const World& world = b.simulation->world();
    return world.value(world.robots()[0]->base(), keys::pose).position.z();
  }
  test::ScratchFolder folder_;
};

TEST_F(ARobotWithAJoint, StandsOnTheGroundAsItIsAtTheStart) {
  EXPECT_NEAR(height(built(about_zero)), 0.1, 1e-12) << "the ball is as low as the box";
  EXPECT_NEAR(height(built(about_zero, ", joints: {lift: 0.75}")), std::sin(0.75) + 0.1, 1e-12);
  EXPECT_NEAR(height(built(about_zero, ", joints: {lift: -0.75}")), 0.1, 1e-12) << "the boom is up";
}

TEST_F(ARobotWithAJoint, StartsAtTheLimitWhereItCannotBeAtZero) {
  const BuiltScenario b = built(above_zero);
  EXPECT_NEAR(height(b), std::sin(0.5) + 0.1, 1e-12);
  const World& world = b.simulation->world();
  EXPECT_EQ(world.value("crane/lift", keys::initial_joint_position), 0.5);
  ASSERT_EQ(b.clamped.size(), 1u);
  EXPECT_SAYS(b.clamped[0],
              "crane.yaml:2:18: robot `crane`: 1 joint cannot be at 0 and starts at the nearest limit: `lift` at 0.5 "
              "(0.5 to 1.25 rad); set `joints` of the robot to start elsewhere");
  EXPECT_TRUE(built(above_zero, ", joints: {lift: 1}").clamped.empty()) << "it was asked for";
  EXPECT_TRUE(built(about_zero).clamped.empty());
}

TEST_F(ARobotWithAJoint, IsRefusedByStrictWhereItStartsAtALimitUnasked) {
  const BuiltScenario b = built(above_zero);
  EXPECT_SAYS(test::complaint_of<SetupError>([&] { report_unsupported(b, Detail::brief, true); }),
              "--strict lets no joint start at a limit unasked; set `joints`, or leave --strict out");
}

TEST_F(ARobotWithAJoint, IsNotPutOutsideOfItsLimits) {
  const auto refusal = [&](const std::string& joints) {
    return test::complaint_of<SetupError>([&] { built(above_zero, ", joints: {" + joints + "}"); });
  };
  EXPECT_SAYS(refusal("lift: 2"),
              "crane.yaml:2:39: joint `lift` of robot `crane` starts at 2, outside of its limits 0.5 to 1.25 rad");
  EXPECT_SAYS(refusal("lfit: 1"), "robot `crane` has no joint `lfit` (did you mean `lift`?); it has: lift, wave");
}

TEST_F(ARobotWithAJoint, KeepsRandomPlacesClearOfItsReach) {
  folder_.file("crane.urdf", crane(about_zero));
  const auto complaint = [&](const std::string& joints) {
    const std::string file =
        folder_.file("yard.yaml",
                     "world: {places: {yard: [{center: [0, 0], size: [1.9, 0.01]}]}}\nrobots:\n  crane: {model: "
                     "crane.urdf, count: 2, place: {random: yard, seed: 3, clearance: 0}" +
                         joints + "}\n");
    return test::complaint_of<SetupError>([&] { build(read_scenario(file, {}), test::plugins()); });
  };
  EXPECT_SAYS(complaint(""), "crane");
  EXPECT_EQ(complaint(", joints: {lift: 1}"), "no complaint") << "0.64 m from its middle, and not 1.1";
}

}  // namespace
}  // namespace muro::host
