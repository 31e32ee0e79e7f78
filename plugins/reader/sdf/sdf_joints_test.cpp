// SPDX-License-Identifier: MIT
// Every type of joint: poses of its links, compared with SDFormat's definition.
#include <gtest/gtest.h>

#include <numbers>

#include "muro/toolkit/joint_drives.hpp"
#include "muro/toolkit/rotations.hpp"
#include "reading_testing.hpp"
#include "tests/support/complaint.hpp"

namespace muro::sdf {
namespace {

using std::numbers::pi;

Quat about(const Vec3& axis, double angle) { return Quat(Eigen::AngleAxisd(angle, axis.normalized())); }

/// Returns links a and b, b 1 m above a and turned, and a joint with its frame away from b's origin.
Robot two_links(const std::string& type, const std::string& inside) {
  return robot_of(model(link("a", "<pose>5 0 0 0 0 0.3</pose>") +
                        link("b", "<pose relative_to='a'>0 0 1 0 0 1.5707963267948966</pose>") +
                        joint("j", type, "a", "b", inside)));
}
const Pose b_at_rest{{0, 0, 1}, from_rpy(0, 0, pi / 2)};
/// Pose of the joint in a, with the joint's <pose> of 0.1 0.2 0.3 in b.
const Pose joint_in_a = b_at_rest * Pose{{0.1, 0.2, 0.3}, Quat::Identity()};
constexpr char off[] = "<pose>0.1 0.2 0.3 0 0 0</pose>";

/// Returns the pose of b in a after a `motion` of the joint, given in the joint's frame.
Pose moved(const Pose& motion) { return joint_in_a * motion * joint_in_a.inverse() * b_at_rest; }

TEST(SdfJoints, ARevoluteJointTurnsTheChildAboutItsAxisWhereverItsFrameIs) {
  const Robot robot = two_links(
      "revolute", off + axis("0 1 0",
                             "<limit><lower>-1</lower><upper>2</upper><effort>3</effort><velocity>4</velocity></limit>"
                             "<dynamics><damping>5</damping><friction>6</friction></dynamics>"));
  EXPECT_EQ(robot.problems, Lines{});
  EXPECT_EQ(robot.blocks(),
            (Lines{"base a", "translation", "rotation", "revolute j", "body j_frame", "translation", "body b"}));
  EXPECT_TRUE(near(robot.pose("b"), b_at_rest));
  EXPECT_TRUE(near(robot.pose("b", {{"j", 0.7}}), moved({Vec3::Zero(), about(Vec3::UnitY(), 0.7)})));
  const JointLimits& limits = robot.joint("j")->link.limits;
  EXPECT_EQ(limits.lower, -1);
  EXPECT_EQ(limits.upper, 2);
  EXPECT_EQ(limits.effort, 3);
  EXPECT_EQ(limits.velocity, 4);
  EXPECT_EQ(limits.damping, 5);
  EXPECT_EQ(limits.friction, 6);
}

TEST(SdfJoints, ARotorIsFeltWithTheSquareOfItsGearRatio) {
  const auto armature = [](const std::string& inside) {
    const Robot robot = two_links("revolute", axis("0 0 1") + inside);
    EXPECT_EQ(robot.problems, Lines{});
    return robot.joint("j")->link.limits.armature;
  };
  EXPECT_EQ(armature(""), 0);
  EXPECT_EQ(armature("<drake:rotor_inertia>1.5</drake:rotor_inertia>"), 1.5);
  EXPECT_EQ(armature("<drake:rotor_inertia>1.5</drake:rotor_inertia><drake:gear_ratio>300.0</drake:gear_ratio>"),
            1.5 * 300 * 300);
  EXPECT_EQ(armature("<drake:gear_ratio>300.0</drake:gear_ratio>"), 0);
}

TEST(SdfJoints, RotorsThatAreNoneAreTold) {
  const Robot negative = two_links("revolute", axis("0 0 1") + "<drake:rotor_inertia>-1</drake:rotor_inertia>");
  EXPECT_SAYS(negative.problems.at(0),
              "joint `j`: the inertia of its rotor is left out; <drake:rotor_inertia> and "
              "<drake:gear_ratio> are from 0 to 1e7");
  EXPECT_EQ(negative.joint("j")->link.limits.armature, 0);
  const Robot ball = two_links("ball", "<drake:rotor_inertia>1</drake:rotor_inertia>");
  EXPECT_SAYS(ball.problems.at(0), "the inertia of its rotor is left out; only joints with one axis have one");
}

TEST(SdfJoints, AnAxisThroughTheChildsOriginNeedsNoFrameBetween) {
  const Robot robot = two_links("revolute", "<pose>0 0 0.3 0 0 0.5</pose>" + axis("0 0 1"));
  EXPECT_EQ(robot.blocks(), (Lines{"base a", "translation", "rotation", "revolute j", "body b"}));
  EXPECT_TRUE(near(robot.pose("b", {{"j", 0.7}}), b_at_rest * Pose{Vec3::Zero(), about(Vec3::UnitZ(), 0.7)}));
}

TEST(SdfJoints, LimitsOf1e16NegativeEffortAndInfinityStandForNone) {
  constexpr double none = std::numeric_limits<double>::infinity();
  for (const char* limit :
       {"", "<limit><lower>-1e16</lower><upper>1e16</upper><effort>-1</effort><velocity>-1</velocity></limit>",
        "<limit><lower>-inf</lower><upper>inf</upper></limit>"}) {
    const Robot robot = two_links("revolute", axis("0 0 1", limit));
    EXPECT_EQ(robot.problems, Lines{});
    const JointLimits& limits = robot.joint("j")->link.limits;
    EXPECT_EQ(limits.lower, -none);
    EXPECT_EQ(limits.upper, none);
    EXPECT_EQ(limits.effort, none);
    EXPECT_EQ(limits.velocity, none);
    EXPECT_EQ(limits.damping, 0);
  }
}

TEST(SdfJoints, AContinuousJointHasNoLimitsOfPosition) {
  const Robot robot =
      two_links("continuous", axis("0 0 1", "<limit><lower>-1</lower><upper>1</upper><effort>3</effort></limit>"));
  EXPECT_EQ(robot.joint("j")->link.limits.upper, std::numeric_limits<double>::infinity());
  EXPECT_EQ(robot.joint("j")->link.limits.effort, 3);
}

TEST(SdfJoints, APrismaticJointShiftsTheChildAlongItsAxis) {
  const Robot robot = two_links("prismatic", off + axis("1 0 0"));
  EXPECT_EQ(robot.problems, Lines{});
  EXPECT_EQ(robot.joint("j")->link.joint, JointKind::prismatic);
  EXPECT_TRUE(near(robot.pose("b", {{"j", 0.7}}), moved({{0.7, 0, 0}, Quat::Identity()})));
}

TEST(SdfJoints, AFixedJointHoldsTheChild) {
  const Robot robot = two_links("fixed", off);
  EXPECT_EQ(robot.problems, Lines{});
  EXPECT_EQ(robot.blocks(), (Lines{"base a", "translation", "rotation", "body b"}));
  EXPECT_TRUE(near(robot.pose("b"), b_at_rest));
}

TEST(SdfJoints, UniversalAndRevolute2AreTwoRevoluteJoints) {
  for (const char* type : {"universal", "revolute2"}) {
    const Robot robot = two_links(type, off + axis("1 0 0", "<limit><lower>-1</lower><upper>1</upper></limit>") +
                                            axis("0 1 0", "<limit><lower>-2</lower><upper>2</upper></limit>", "axis2"));
    EXPECT_EQ(robot.problems, Lines{});
    EXPECT_TRUE(near(robot.pose("b"), b_at_rest));
    // the first axis stays with the parent, the second moves with the child
    const Quat turn = about(Vec3::UnitX(), 0.4) * about(Vec3::UnitY(), 0.9);
    EXPECT_TRUE(near(robot.pose("b", {{"j_axis", 0.4}, {"j_axis2", 0.9}}), moved({Vec3::Zero(), turn})));
    EXPECT_EQ(robot.joint("j_axis")->link.limits.upper, 1);
    EXPECT_EQ(robot.joint("j_axis2")->link.limits.upper, 2);
    EXPECT_EQ(robot.constants("j_axis_body", keys::inertial).size(), 0u);
  }
}

TEST(SdfJoints, ABallIsThreeRevoluteJointsAndSaysSo) {
  const Robot robot = two_links("ball", off);
  EXPECT_EQ(robot.problems.size(), 1u);
  EXPECT_NE(robot.problems[0].find(
                "joint `j` is a ball; it is made of the revolute joints `j_x`, `j_y` and `j_z`, which cannot "
                "turn freely where the second is at 90 degrees"),
            std::string::npos)
      << robot.problems[0];
  const Quat turn = about(Vec3::UnitX(), 0.1) * about(Vec3::UnitY(), 0.2) * about(Vec3::UnitZ(), 0.3);
  EXPECT_TRUE(near(robot.pose("b", {{"j_x", 0.1}, {"j_y", 0.2}, {"j_z", 0.3}}), moved({Vec3::Zero(), turn})));
}

TEST(SdfJoints, AScrewSlidesAsItTurns) {
  // SDFormat 1.10: one turn moves the child by -2 pi / thread_pitch
  const Robot robot = two_links("screw", axis("0 0 1") + "<thread_pitch>-4</thread_pitch>");
  EXPECT_EQ(robot.problems, Lines{});
  const Link& slide = robot.joint("j_slide")->link;
  EXPECT_EQ(slide.joint, JointKind::prismatic);
  EXPECT_EQ(robot.joint("j_slide")->mimic_leader, "j");
  EXPECT_EQ(slide.mimic_multiplier * 2 * pi, -2 * pi / -4);
  const Robot newer = two_links("screw", axis("0 0 1") + "<screw_thread_pitch>0.5</screw_thread_pitch>");
  EXPECT_NEAR(newer.joint("j_slide")->link.mimic_multiplier * 2 * pi, 0.5, 1e-15);
}

std::string wheels(const std::string& gear) {
  return model(link("frame") + link("small") + link("large", "<pose>1 0 0 0 0 0</pose>") +
               joint("js", "continuous", "frame", "small", axis("0 0 1")) +
               joint("jl", "continuous", "frame", "large", axis("0 0 -1")) + "\n" +
               "<joint name='g' type='gearbox'><parent>small</parent><child>large</child>"
               "<gearbox_ratio>2.5</gearbox_ratio><gearbox_reference_body>frame</gearbox_reference_body>" +
               gear + "</joint>");
}

TEST(SdfJoints, AGearboxMakesTheChildsJointFollowTheParents) {
  const Robot robot = robot_of(wheels(axis("0 0 1") + axis("0 0 1", "", "axis2")));
  EXPECT_EQ(robot.problems, Lines{});
  // theta_2 = -2.5 theta_1 about z, and jl is positive about -z
  EXPECT_EQ(robot.joint("jl")->mimic_leader, "js");
  EXPECT_EQ(robot.joint("jl")->link.mimic_multiplier, 2.5);
}

TEST(SdfJoints, AGearboxAboutOtherAxesThanItsWheelsIsLeftOut) {
  const Robot robot = robot_of(wheels(axis("0 0 1") + axis("0 1 0", "", "axis2")));
  EXPECT_EQ(robot.problems,
            Lines{"warning 4:1 gearbox `g` is left out: its parent and its child each need a revolute joint with the "
                  "<gearbox_reference_body>, about the gearbox's axis and axis2"});
}

TEST(SdfJoints, AMimicOfAMimicFollowsTheFirst) {
  const auto mimic = [](const std::string& leader, const std::string& more) {
    return "<mimic joint='" + leader + "'>" + more + "</mimic>";
  };
  const Robot robot = robot_of(model(
      link("a") + link("b") + link("c") + link("d") + joint("j", "revolute", "a", "b", axis("0 0 1")) +
          joint("k", "revolute", "b", "c",
                axis("0 0 1", mimic("j", "<multiplier>2</multiplier><offset>1</offset><reference>0.25</reference>"))) +
          joint("l", "revolute", "c", "d", axis("0 0 1", mimic("k", "<multiplier>3</multiplier>"))),
      "1.11"));
  EXPECT_EQ(robot.problems.size(), 1u);  // message about the version
  // k = 2 (j - 0.25) + 1, l = 3 k
  EXPECT_EQ(robot.joint("k")->link.mimic_multiplier, 2);
  EXPECT_EQ(robot.joint("k")->link.mimic_offset, 0.5);
  EXPECT_EQ(robot.joint("l")->mimic_leader, "j");
  EXPECT_EQ(robot.joint("l")->link.mimic_multiplier, 6);
  EXPECT_EQ(robot.joint("l")->link.mimic_offset, 1.5);
}

TEST(SdfJoints, TellsOfMimicsBeyondTheirLimits) {
  const auto limit = [](const std::string& upper) {
    return "<limit><lower>0</lower><upper>" + upper + "</upper></limit>";
  };
  const Robot robot =
      robot_of(model(link("a") + link("b") + link("c") + joint("j", "revolute", "a", "b", axis("0 0 1", limit("0.8"))) +
                         joint("k", "revolute", "a", "c",
                               axis("0 0 1", limit("0.88") + "<mimic joint='j'><multiplier>-1</multiplier></mimic>")),
                     "1.11"));
  ASSERT_EQ(robot.problems.size(), 2u);  // message about the version, and the tested warning
  EXPECT_NE(
      robot.problems.back().find("joint `k` mimics `j`, which takes it from -0.8 to 0, beyond its own limits 0 to "
                                 "0.88; it goes there"),
      std::string::npos)
      << robot.problems.back();
}

TEST(SdfJoints, AJointThatFixesTheBaseToTheWorldIsForTheMotion) {
  const Robot robot = robot_of(model(link("a") + link("b") + joint("j", "revolute", "a", "b", axis("0 0 1")) + "\n" +
                                     joint("w", "fixed", "world", "a")));
  EXPECT_EQ(robot.problems, Lines{"note 4:1 joint `w` fixes the robot to the world: set `base: fixed` in the motion"});
  EXPECT_EQ(robot.blocks().front(), "base a");
}

TEST(SdfJoints, AJointOnTheWorldThatMovesHangsOnABodyForTheWorld) {
  const Robot robot = robot_of(
      model(link("a", "<pose>0 0 2 0 0 0</pose>") + "\n" + joint("w", "revolute", "world", "a", axis("0 1 0"))));
  EXPECT_EQ(robot.problems, Lines{"note 4:1 joint `w` fixes the robot to the world: set `base: fixed` in the motion"});
  EXPECT_EQ(robot.blocks(), (Lines{"base world", "translation", "revolute w", "body a"}));
  EXPECT_TRUE(near(robot.pose("a"), {{0, 0, 2}, Quat::Identity()}));
}

TEST(SdfJoints, TheBallOfACasterIsFixedAndSlidesWithoutFriction) {
  const std::string sphere =
      "<collision name='c'><geometry><sphere><radius>0.02</radius></sphere></geometry></collision>";
  const auto caster = [&](const std::string& shape, const std::string& at) {
    return robot_of(model(link("a") + link("b", shape) + joint("j", "ball", "a", "b", "<pose>" + at + "</pose>")));
  };
  const Robot robot = caster(sphere, "0 0 0 0 0 0");
  EXPECT_EQ(robot.joint("j_x"), nullptr);
  ASSERT_EQ(robot.constants("b", keys::collision_shapes).size(), 1u);
  EXPECT_EQ(robot.constants("b", keys::collision_shapes)[0].surface.friction, 0);
  ASSERT_EQ(robot.problems.size(), 1u);
  EXPECT_NE(robot.problems[0].find("joint `j` is the ball joint of a caster"), std::string::npos);
  EXPECT_NE(caster(sphere, "0 0 0.1 0 0 0").joint("j_y"), nullptr) << "the joint is beside the sphere";
  EXPECT_NE(caster("", "0 0 0 0 0 0").joint("j_y"), nullptr) << "nothing rolls";
}

TEST(SdfJoints, SpringsArePositionDrivesTowardsTheirReference) {
  const Robot robot = two_links(
      "revolute",
      axis("0 0 1",
           "<dynamics><spring_stiffness>7</spring_stiffness><spring_reference>0.5</spring_reference></dynamics>"));
  EXPECT_EQ(robot.constants("j", keys::joint_drive), std::vector<std::uint32_t>{std::uint32_t(DriveMode::position)});
  EXPECT_EQ(robot.constants("j", keys::joint_drive_stiffness), std::vector<double>{7});
  EXPECT_EQ(robot.constants("j", keys::joint_drive_damping), std::vector<double>{0});
  EXPECT_EQ(robot.constants("j", keys::joint_position_target), std::vector<double>{0.5});
}

}  // namespace
}  // namespace muro::sdf
