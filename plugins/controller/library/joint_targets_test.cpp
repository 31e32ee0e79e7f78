// SPDX-License-Identifier: MIT
// Control code commands joints: motions follow its outputs, although its ports are connected by name.
#include "library_testing.hpp"

namespace muro::control {
namespace {

constexpr double ramp_step = 1e-3, ramp_speed = 0.5;

/// An arm of 0.26 kg m^2 on a fixed base without gravity. A ramp of 0.5 rad/s commands its joint at each step.
struct RampedArm : test::Scene {
  RampedArm(const std::string& motion, const std::string& library, const Texts& outputs, Settings of_motion = {}) {
    world().set(world_object, keys::gravity, Vec3(0, 0, 0));
    const RobotView& arm =
        add("arm", test::tree_of([](RobotBuilder& b) {
              b.base("body");
              b.set(keys::inertial, {.mass = 5, .ixx = 1, .iyy = 1, .izz = 1});
              b.revolute("joint", Vec3::UnitY(), {});
              b.body("forearm");
              b.set(keys::inertial, {.mass = 1, .com = {0.5, 0, 0}, .ixx = 0.01, .iyy = 0.01, .izz = 0.01});
            }));
    if (motion != "motion.point") of_motion.insert({{"base", "fixed"}, {"joints", "position"}});
    use(motion, 1000, all_robots(), of_motion);
    use("controller.library", 1000, {{&arm, arm.base()}}, {{"library", folder + library}, {"outputs", outputs}});
  }
  double& joint(const Key<double>& key) { return world().value("arm/joint", key); }
  /// Returns the lag after a second, when drives have settled. The last target is from the step before the end.
  double behind_the_target() {
    build();
    run_for(1);
    return ramp_speed * (1 - ramp_step) - joint(keys::joint_position);
  }
};

const Texts position_alone{"position=joint:joint.position.target"};
const Texts position_and_velocity{"position=joint:joint.position.target", "velocity=joint:joint.velocity.target"};

class PositionDrive : public testing::TestWithParam<std::string> {};

/// The balance is stiffness error = damping speed. At critical damping the lag is 2 speed / natural_frequency.
TEST_P(PositionDrive, IsBehindARampOfPositions) {
  RampedArm s(GetParam(), "ramp.so", position_alone, {{"natural_frequency", 50.0}});
  EXPECT_NEAR(s.behind_the_target(), 2 * ramp_speed / 50, 1e-4);
}

TEST_P(PositionDrive, IsNotBehindWithTheVelocityOfARamp) {
  RampedArm s(GetParam(), "ramp_with_velocity.so", position_and_velocity, {{"natural_frequency", 50.0}});
  EXPECT_NEAR(s.behind_the_target(), 0, 1e-4);
}

std::vector<std::string> motions_with_drives() {
  std::vector<std::string> found;
  for (const CatalogEntry& e : test::plugins().catalog())
    for (const char* id : {"motion.simplified", "motion.articulated", "motion.bullet", "motion.ode", "motion.mujoco"})
      if (e.id == id) found.emplace_back(id);
  return found;
}

INSTANTIATE_TEST_SUITE_P(Motions, PositionDrive, testing::ValuesIn(motions_with_drives()),
                         [](const auto& test) { return test.param.substr(test.param.find('.') + 1); });

TEST(JointTargets, OfMotionPointAreFollowed) {
  RampedArm positions("motion.point", "ramp.so", position_alone);
  EXPECT_NEAR(positions.behind_the_target(), 0, 1e-12);
  RampedArm positions_first("motion.point", "ramp_with_velocity.so", position_and_velocity);
  EXPECT_NEAR(positions_first.behind_the_target(), 0, 1e-12);
}

TEST(JointTargets, OfVelocityAloneMoveAJointOfMotionPoint) {
  RampedArm s("motion.point", "ramp.so", {"position=joint:joint.velocity.target"});
  s.build();
  s.run_for(1);
  EXPECT_NEAR(s.joint(keys::joint_position), ramp_speed * 0.5 * (1 - ramp_step), 1e-9) << "the sum of v t dt";
}

TEST(JointTargets, OfVelocityMayBeNamedByAPattern) {
  RampedArm s("motion.simplified", "ramp_with_velocity.so", {position_alone[0], "velocity=*:joint.velocity.target"});
  EXPECT_NEAR(s.behind_the_target(), 0, 1e-4);
}

TEST(JointTargets, OfVelocityThatNobodyFollowsAreRefused) {
  RampedArm s("motion.point", "ramp_with_velocity.so", position_and_velocity, {{"joints", "position"}});
  EXPECT_TRUE(says(refusal(s), "`arm/joint:joint.velocity.target` (wanted velocity"));
  RampedArm passive("motion.point", "ramp_with_velocity.so", position_and_velocity, {{"joints", "passive"}});
  EXPECT_TRUE(says(refusal(passive), "object `arm/joint` has no property `joint.position.target`"));
}

}  // namespace
}  // namespace muro::control
