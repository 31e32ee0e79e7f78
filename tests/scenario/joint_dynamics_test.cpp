// SPDX-License-Identifier: MIT
// Damping, friction and armature of joints that the scenario gives instead of the model.
#include <gtest/gtest.h>

#include "host/scenario/builder.hpp"
#include "host/scenario/features/unsupported_features.hpp"
#include "muro/vocabulary.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::host {
namespace {

/// A box with two flywheels of 0.02 kg m^2.
const std::string flywheels = R"(<robot name="r">
<link name="box"><inertial><mass value="5"/><inertia ixx="1" iyy="1" izz="1" ixy="0" ixz="0" iyz="0"/></inertial></link>
<link name="a"><inertial><mass value="1"/><inertia ixx="0.02" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial>
</link>
<link name="b"><inertial><mass value="1"/><inertia ixx="0.02" iyy="0.02" izz="0.02" ixy="0" ixz="0" iyz="0"/></inertial>
</link>
<joint name="wheel_a" type="continuous"><parent link="box"/><child link="a"/><axis xyz="0 0 1"/>
<dynamics damping="0.5" friction="0.25"/></joint>
<joint name="wheel_b" type="continuous"><parent link="box"/><child link="b"/><axis xyz="0 0 1"/></joint>
</robot>)";

class DynamicsOfJoints : public testing::Test {
 protected:
  BuiltScenario built(const std::string& dynamics, const std::string& motion = "motion.simplified") {
    folder_.file("r.urdf", flywheels);
    return build(read_scenario(folder_.file("r.yaml", "robots:\n  r:\n    model: r.urdf\n    dynamics: " + dynamics +
                                                          "\n    motion: {use: " + motion +
                                                          ", motion.simplified: {base: fixed, joints: effort}}\n"),
                               {}),
                 test::plugins());
  }
  static const JointLimits& of(const BuiltScenario& b, std::size_t link) {
    return b.simulation->world().robots()[0]->links[link].limits;
  }
  std::string refusal(const std::string& dynamics) {
    return test::complaint_of<SetupError>([&] { built(dynamics); });
  }
  test::ScratchFolder folder_;
};

TEST_F(DynamicsOfJoints, StandInPlaceOfTheModels) {
  const BuiltScenario b = built("{wheel_a: {armature: 0.08}, wheel_b: {damping: 2, friction: 3}}");
  EXPECT_EQ(of(b, 1).armature, 0.08);
  EXPECT_EQ(of(b, 1).damping, 0.5) << "the model's";
  EXPECT_EQ(of(b, 1).friction, 0.25) << "the model's";
  EXPECT_EQ(of(b, 2).armature, 0);
  EXPECT_EQ(of(b, 2).damping, 2);
  EXPECT_EQ(of(b, 2).friction, 3);
}

TEST_F(DynamicsOfJoints, OfALaterNameCountWhereSeveralNameAJoint) {
  const BuiltScenario b = built("{\"wheel_*\": {armature: 0.08, damping: 0}, wheel_b: {armature: 0.5}}");
  EXPECT_EQ(of(b, 1).armature, 0.08);
  EXPECT_EQ(of(b, 1).damping, 0);
  EXPECT_EQ(of(b, 2).armature, 0.5);
}

TEST_F(DynamicsOfJoints, SlowARotorsJointAsItsInertiaSays) {
  const BuiltScenario b = built("{\"*\": {armature: 0.08, damping: 0, friction: 0}}");
  b.simulation->world().value("r/wheel_b", keys::joint_effort_target) = 0.2;
  b.simulation->run_until(1'000'000'000);
  EXPECT_NEAR(b.simulation->world().value("r/wheel_b", keys::joint_velocity), 0.2 / (0.02 + 0.08), 1e-9);
}

TEST_F(DynamicsOfJoints, AreRefusedWithTheirPlace) {
  EXPECT_SAYS(refusal("{wheel_c: {armature: 1}}"),
              "r.yaml:4:16: `dynamics` of robot `r` names `wheel_c`, and there is no such joint (did you mean "
              "`wheel_a`?); it has: wheel_a, wheel_b");
  EXPECT_SAYS(refusal("{wheel_a: {armature: -1}}"), "armature");
  EXPECT_SAYS(refusal("{wheel_a: {armature: heavy}}"), "armature");
  EXPECT_SAYS(refusal("{wheel_a: {rotor: 1}}"), "rotor");
  EXPECT_SAYS(refusal("{wheel_a: 3}"), "must be a map of `key: value` pairs, not `3`");
  EXPECT_SAYS(refusal("5"), "dynamics");
}

TEST_F(DynamicsOfJoints, AreToldWhereAMotionKnowsNoForces) {
  const auto unsupported = find_unsupported_features(built("{wheel_a: {armature: 0.08}}", "motion.point"));
  ASSERT_EQ(unsupported.size(), 1u);
  EXPECT_EQ(text_of(unsupported[0], Detail::brief).find("rotors"), std::string::npos) << "forces say it";
  EXPECT_SAYS(text_of(unsupported[0], Detail::full), "armature (1 joint)");
}

}  // namespace
}  // namespace muro::host
