// SPDX-License-Identifier: MIT
// Robots from the example models and from small URDF documents.
#include <gtest/gtest.h>

#include <numbers>

#include "core/world.hpp"
#include "muro/toolkit/rotations.hpp"
#include "recording_builder.hpp"
#include "tests/support/files.hpp"
#include "tests/support/scene.hpp"

namespace muro::urdf {
namespace {

using std::numbers::pi;
using Lines = std::vector<std::string>;

std::string example(const std::string& name) {
  return std::string(MURO_TEST_SOURCE_DIR) + "/examples/models/" + name + ".urdf";
}

RecordingBuilder recorded_file(const std::string& name) {
  RecordingBuilder builder;
  read_file(example(name), builder);
  return builder;
}

/// Returns a robot of body `a` and the elements `more`.
RecordingBuilder with_body_a(const std::string& more) {
  return recorded("<robot name='r'>\n" + std::string(body_a) + "\n" + more + "\n</robot>");
}

double total_mass(const RecordingBuilder& robot) {
  double mass = 0;
  for (const auto& [name, inertia] : robot.inertials) mass += inertia.mass;
  return mass;
}

TEST(UrdfModels, TheRoverBecomesNestedBinaryForksInTheOrderOfTheFile) {
  const RecordingBuilder rover = recorded_file("rover");
  EXPECT_EQ(rover.problems, Lines{});
  const Lines expected = {"base base_link",
                          "fork",
                          "translation 0.12 0.15 -0.03",
                          "revolute front_left_wheel_joint about 0 1 0",
                          "body front_left_wheel",
                          "end",
                          "fork",
                          "translation 0.12 -0.15 -0.03",
                          "revolute front_right_wheel_joint about 0 1 0",
                          "body front_right_wheel",
                          "end",
                          "fork",
                          "translation -0.12 0.15 -0.03",
                          "revolute rear_left_wheel_joint about 0 1 0",
                          "body rear_left_wheel",
                          "end",
                          "fork",
                          "translation -0.12 -0.15 -0.03",
                          "revolute rear_right_wheel_joint about 0 1 0",
                          "body rear_right_wheel",
                          "end",
                          "translation 0.1 0 0.03",
                          "body laser_link",
                          "end",
                          "end",
                          "end",
                          "end"};
  EXPECT_EQ(rover.calls, expected);
}

TEST(UrdfModels, TheRoversInertiasAreThoseOfEvenSolids) {
  const RecordingBuilder rover = recorded_file("rover");
  const Inertia& chassis = rover.inertials.at("base_link");
  EXPECT_EQ(chassis.mass, 4);
  EXPECT_NEAR(chassis.ixx, 4 / 12.0 * (0.25 * 0.25 + 0.12 * 0.12), 1e-6);
  EXPECT_NEAR(chassis.iyy, 4 / 12.0 * (0.35 * 0.35 + 0.12 * 0.12), 1e-6);
  EXPECT_NEAR(chassis.izz, 4 / 12.0 * (0.35 * 0.35 + 0.25 * 0.25), 1e-6);
  for (const char* name : {"front_left_wheel", "front_right_wheel", "rear_left_wheel", "rear_right_wheel"}) {
    const Inertia& wheel = rover.inertials.at(name);
    EXPECT_EQ(wheel.mass, 0.3);
    EXPECT_NEAR(wheel.iyy, 0.5 * 0.3 * 0.06 * 0.06, 1e-9);
    EXPECT_NEAR(wheel.ixx, 0.3 * (3 * 0.06 * 0.06 + 0.04 * 0.04) / 12, 1e-9);
    EXPECT_EQ(wheel.ixx, wheel.izz);
  }
  EXPECT_EQ(rover.inertials.at("laser_link").mass, 0.16);
  EXPECT_NEAR(total_mass(rover), 4 + 4 * 0.3 + 0.16, 1e-12);
}

TEST(UrdfModels, TheRoversWheelsAreCylindersAboutTheirAxles) {
  const RecordingBuilder rover = recorded_file("rover");
  ASSERT_EQ(rover.collisions.at("front_left_wheel").size(), 1u);
  const Shape& wheel = rover.collisions.at("front_left_wheel")[0];
  EXPECT_EQ(wheel.kind, ShapeKind::cylinder);
  EXPECT_EQ(wheel.size, Vec3(0.06, 0, 0.04));
  EXPECT_EQ(wheel.surface.friction, 0.8);
  EXPECT_NEAR(std::abs((wheel.origin.orientation * Vec3::UnitZ()).y()), 1, 1e-15);
  EXPECT_EQ(rover.collisions.at("base_link")[0].size, Vec3(0.35, 0.25, 0.12));
  EXPECT_EQ(rover.collisions.at("base_link")[0].surface.friction, 0.4);
  EXPECT_TRUE(rover.visuals.at("base_link")[0].color.isApprox(Eigen::Vector4d(0.9, 0.45, 0.1, 1), 1e-6));
  EXPECT_EQ(rover.collisions.count("laser_link"), 0u);
  const JointLimits& limits = rover.limits.at("front_left_wheel_joint");
  EXPECT_EQ(limits.lower, -std::numeric_limits<double>::infinity());
  EXPECT_EQ(limits.upper, std::numeric_limits<double>::infinity());
  EXPECT_EQ(limits.velocity, 40);
  EXPECT_EQ(limits.effort, 0.8);
  EXPECT_EQ(limits.damping, 0.002);
  EXPECT_EQ(limits.friction, 0.01);
}

TEST(UrdfModels, EveryExampleIsReadThroughThePluginWithItsMassAndJoints) {
  struct Expected {
    const char* name;
    double mass;
    std::size_t links, joints, problems;
  };
  // the only problem is the planar joint of the air table
  const Expected expected[] = {
      {"rover", 5.36, 6, 4, 0},       {"pendulum", 6.1, 3, 1, 0},          {"arm", 7.41, 8, 7, 0},
      {"quadruped", 12, 17, 12, 0},   {"biped", 4.06, 23, 20, 0},          {"air_table", 14.07, 7, 6, 1},
      {"humanoid", 3.147, 27, 21, 0}, {"quadruped_a1", 12.776, 20, 12, 0}, {"soccer_omni", 2.6, 8, 4, 0},
      {"car", 3.63, 8, 6, 0},         {"mecanum", 20.16, 6, 4, 0},         {"kiwi", 11.06, 5, 3, 0}};
  for (const Expected& e : expected) {
    SCOPED_TRACE(e.name);
    test::Scene scene;
    const RobotTree tree = scene.read_model(example(e.name));
    EXPECT_EQ(tree.problems().size(), e.problems);
    const RobotView& robot = scene.world().add_robot("robot", tree, Pose{});
    ASSERT_EQ(robot.links.size(), e.links);
    double mass = 0;
    std::size_t joints = 0;
    for (const Link& frame : robot.links) {
      joints += frame.joint != JointKind::fixed;
      const ArrayHeader found = scene.world().store().constant(frame.object, keys::inertial);
      if (const auto* inertia = static_cast<const Inertia*>(found.data)) {
        mass += inertia->mass;
        const double largest = std::max({inertia->ixx, inertia->iyy, inertia->izz});
        EXPECT_GE(inertia->ixx + inertia->iyy + inertia->izz - largest, 0.999 * largest);
      }
    }
    EXPECT_NEAR(mass, e.mass, 1e-12);
    EXPECT_EQ(joints, e.joints);
  }
}

TEST(UrdfModels, TheRoverStandsOnItsWheels) {
  test::Scene scene;
  const RobotTree tree = scene.read_model(example("rover"));
  EXPECT_NEAR(tree.standing_height(), 0.06 + 0.03, 1e-12);
}

TEST(UrdfModels, ThePendulumHasTheReducedLengthOfARodWithABall) {
  const RecordingBuilder p = recorded_file("pendulum");
  const Inertia whole = p.inertials.at("rod") + p.inertials.at("ball").in({{0, 0, -1}, Quat::Identity()});
  EXPECT_NEAR(whole.about(Vec3::Zero())(1, 1), 0.1 / 12 * (3e-4 + 1) + 0.1 * 0.25 + 0.4 * 0.05 * 0.05 + 1, 1e-6);
  EXPECT_NEAR(whole.com.z(), -(0.1 * 0.5 + 1) / 1.1, 1e-12);
}

TEST(UrdfModels, AFingerOfTheArmMimicsTheOther) {
  const RecordingBuilder arm = recorded_file("arm");
  const auto joint = std::find(arm.calls.begin(), arm.calls.end(), "prismatic right_finger_joint along 0 -1 0");
  ASSERT_NE(joint, arm.calls.end());
  EXPECT_EQ(*std::next(joint), "mimic left_finger_joint * 1 + 0");
}

TEST(UrdfModels, AnOriginIsATranslationAndThenARollPitchYawRotation) {
  const auto robot = with_body_a(
      "<link name='b'/><joint name='j' type='fixed'><parent link='a'/><child link='b'/>"
      "<origin xyz='1 2 3' rpy='0.1 0.2 0.3'/></joint>");
  EXPECT_EQ(robot.calls, (Lines{"base a", "translation 1 2 3", "rotation", "body b"}));
  ASSERT_EQ(robot.rotations.size(), 1u);
  const double c = std::cos(0.3), d = std::sin(0.3);
  // Rz(0.3) Ry(0.2) Rx(0.1) maps x to the first column of Rz Ry
  EXPECT_TRUE(
      (robot.rotations[0] * Vec3::UnitX()).isApprox(Vec3(c * std::cos(0.2), d * std::cos(0.2), -std::sin(0.2)), 1e-14));
  EXPECT_TRUE(robot.rotations[0].isApprox(from_rpy(0.1, 0.2, 0.3), 1e-14));
}

TEST(UrdfModels, TheInertialOriginShiftsTheCentreAndTurnsTheTensor) {
  const auto robot = recorded(
      "<robot name='r'><link name='a'><inertial><origin xyz='1 2 3' rpy='0 0 1.5707963267948966'/><mass value='2'/>"
      "<inertia ixx='0.3' iyy='0.4' izz='0.5' ixy='0.01' ixz='0.02' iyz='0.03'/></inertial></link></robot>");
  EXPECT_EQ(robot.problems, Lines{});
  const Inertia& i = robot.inertials.at("a");
  EXPECT_TRUE(i.com.isApprox(Vec3(1, 2, 3)));
  // a quarter turn about z: x' = y, y' = -x
  Mat3 expected;
  expected << 0.4, -0.01, -0.03, -0.01, 0.3, 0.02, -0.03, 0.02, 0.5;
  EXPECT_TRUE(i.tensor().isApprox(expected, 1e-12)) << i.tensor();
}

TEST(UrdfModels, ShapesKeepTheirKindSizeAndPlace) {
  const auto robot = recorded(
      "<robot name='r'><link name='a'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' "
      "izz='1'/>"
      "</inertial><collision><origin xyz='0 0 1'/><geometry><box size='1 2 3'/></geometry></collision>"
      "<collision><geometry><sphere radius='1e-1'/></geometry></collision>"
      "<collision><geometry><cylinder radius='+0.2' length=' .5 '/></geometry></collision></link>"
      "<gazebo reference='a'><mu1 value='0.3'/><collision><surface><bounce><restitution_coefficient>0.6"
      "</restitution_coefficient></bounce></surface></collision></gazebo></robot>");
  EXPECT_EQ(robot.problems, Lines{});
  const std::vector<Shape>& shapes = robot.collisions.at("a");
  ASSERT_EQ(shapes.size(), 3u);
  EXPECT_EQ(shapes[0].kind, ShapeKind::box);
  EXPECT_EQ(shapes[0].size, Vec3(1, 2, 3));
  EXPECT_EQ(shapes[0].origin.position, Vec3(0, 0, 1));
  EXPECT_EQ(shapes[1].kind, ShapeKind::sphere);
  EXPECT_EQ(shapes[1].size.x(), 0.1);
  EXPECT_EQ(shapes[2].kind, ShapeKind::cylinder);
  EXPECT_EQ(shapes[2].size, Vec3(0.2, 0, 0.5));
  for (const Shape& s : shapes) {
    EXPECT_EQ(s.surface.friction, 0.3);
    EXPECT_EQ(s.surface.restitution, 0.6);
  }
}

TEST(UrdfModels, ACapsuleHasTheLengthOfItsStraightPart) {
  const auto robot = recorded(
      "<robot name='r'><link name='a'><inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' "
      "izz='1'/></inertial><collision><geometry><capsule radius='0.1' length='0.4'/></geometry></collision>"
      "<collision><geometry><cylinder radius='0.1' length='0.4'/></geometry></collision></link></robot>");
  EXPECT_EQ(robot.problems, Lines{});
  const std::vector<Shape>& shapes = robot.collisions.at("a");
  ASSERT_EQ(shapes.size(), 2u);
  EXPECT_EQ(shapes[0].kind, ShapeKind::capsule);
  EXPECT_EQ(shapes[0].size, Vec3(0.1, 0, 0.4));
  EXPECT_EQ(shapes[1].kind, ShapeKind::cylinder);
}

TEST(UrdfModels, ContactOfALinkIsTheSurfaceAsInBulletAndGazeboGoesBeforeIt) {
  const std::string ball =
      "<inertial><mass value='1'/><inertia ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' "
      "izz='1'/></inertial><collision><geometry><sphere radius='1'/></geometry></collision>";
  const auto robot = recorded("<robot name='r'><link name='a'>" + ball +
                              "<contact><lateral_friction value='0.3'/><rolling_friction value='0.01'/>"
                              "<spinning_friction value='0.02'/><restitution value='0.5'/><stiffness value='3e4'/>"
                              "</contact></link><gazebo reference='a'><mu1>0.9</mu1></gazebo></robot>");
  EXPECT_EQ(robot.problems, Lines{});
  const Surface& surface = robot.collisions.at("a").at(0).surface;
  EXPECT_EQ(surface.friction, 0.9);
  EXPECT_EQ(surface.restitution, 0.5);
  EXPECT_EQ(surface.rolling_resistance, 0.01);
  EXPECT_EQ(surface.spinning_resistance, 0.02);
}

TEST(UrdfModels, AColourComesFromTheVisualOrFromTheMaterialOfThatName) {
  const std::string sphere = "<geometry><sphere radius='1'/></geometry>";
  const auto robot = with_body_a(
      "<material name='red'><color rgba='1 0 0 1'/></material>\n<link name='b'>"
      "<visual>" +
      sphere +
      "<material name='red'/></visual>"
      "<visual>" +
      sphere +
      "<material name='red'><color rgba='0 1 0 0.5'/></material></visual>"
      "<visual>" +
      sphere +
      "<material><color rgba='0 0 1 1'/></material></visual>"
      "<visual>" +
      sphere +
      "<material name='own'/></visual>"
      "<visual>" +
      sphere +
      "<material name='own'><color rgba='1 1 0 1'/></material></visual>"
      "<visual>" +
      sphere +
      "</visual></link>"
      "<joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>");
  EXPECT_EQ(robot.problems, Lines{});
  using Color = Eigen::Vector4d;
  const Color expected[] = {{1, 0, 0, 1}, {0, 1, 0, 0.5}, {0, 0, 1, 1}, {1, 1, 0, 1}, {1, 1, 0, 1}, Shape{}.color};
  ASSERT_EQ(robot.visuals.at("b").size(), std::size(expected));
  for (std::size_t i = 0; i < std::size(expected); ++i) EXPECT_EQ(robot.visuals.at("b")[i].color, expected[i]) << i;
}

TEST(UrdfModels, ATextureIsFoundBesideTheModelAndIsWhiteUnlessColoured) {
  const test::ScratchFolder folder;
  folder.file("wood.png", "a picture");
  const std::string sphere = "<visual><geometry><sphere radius='1'/></geometry>";
  const auto robot =
      recorded("<robot name='r'><material name='wood'><texture filename='wood.png'/></material>" +
                   std::string(body_a).replace(std::string(body_a).find("</link>"), 7, "") + sphere +
                   "<material name='wood'/></visual>" + sphere +
                   "<material><color rgba='1 0 0 1'/><texture filename='wood.png'/></material></visual>" + sphere +
                   "<material><texture filename='none.png'/></material></visual></link></robot>",
               folder.path(""));
  ASSERT_EQ(robot.problems.size(), 1u);
  EXPECT_NE(robot.problems[0].find("texture `none.png` is not found; it is plain"), std::string::npos);
  const std::vector<Shape>& shapes = robot.visuals.at("a");
  ASSERT_EQ(shapes.size(), 3u);
  for (const int i : {0, 1}) EXPECT_EQ(robot.texts[std::size_t(shapes[i].texture)], folder.path("wood.png"));
  EXPECT_EQ(shapes[0].color, Eigen::Vector4d::Ones());
  EXPECT_EQ(shapes[1].color, Eigen::Vector4d(1, 0, 0, 1));
  EXPECT_EQ(shapes[2].texture, no_text);
  for (const Shape& s : shapes) EXPECT_EQ(s.material_source, MaterialSource::model);
}

TEST(UrdfModels, APlanarJointIsTwoSlidesAndATurnAboutItsNormal) {
  const auto robot = with_body_a(
      "<link name='b'/><joint name='j' type='planar'><parent link='a'/><child link='b'/>"
      "<axis xyz='0 0 1'/></joint>");
  EXPECT_EQ(robot.calls, (Lines{"base a", "prismatic j_x along 1 0 0", "body j_x_body", "prismatic j_y along 0 1 0",
                                "body j_y_body", "revolute j_yaw about 0 0 1", "body b"}));
  EXPECT_EQ(robot.problems,
            Lines{"warning 3:17 joint `j` is planar; it is made of the prismatic joints `j_x` and `j_y` and "
                  "the revolute joint `j_yaw`, without limits"});
}

TEST(UrdfModels, AJointThatMimicsAMimicFollowsTheirCommonLeader) {
  const std::string joint = " type='continuous'><parent link='a'/>";
  const auto robot = with_body_a(
      "<link name='b'/><link name='c'/><link name='d'/>"
      "<joint name='one'" +
      joint +
      "<child link='b'/></joint>"
      "<joint name='two'" +
      joint +
      "<child link='c'/><mimic joint='one' multiplier='2' offset='0.5'/></joint>"
      "<joint name='three'" +
      joint + "<child link='d'/><mimic joint='two' multiplier='-3' offset='1'/></joint>");
  // q3 = 1 - 3 (0.5 + 2 q1)
  EXPECT_NE(std::find(robot.calls.begin(), robot.calls.end(), "mimic one * -6 + -0.5"), robot.calls.end());
}

TEST(UrdfModels, AQuaternionOfUrdf11TurnsAsRpyDoes) {
  const auto rotation = [](const std::string& origin) {
    return recorded("<robot name='r'>" + std::string(body_a) + link_b +
                    "<joint name='j' type='fixed'><parent link='a'/><child link='b'/><origin " + origin +
                    "/></joint></robot>")
        .rotations.at(0);
  };
  const Quat given = rotation("quat_xyzw='0 0 2 2'");  // the length need not be 1
  EXPECT_NEAR(std::abs(given.dot(rotation("rpy='0 0 1.5707963267948966'"))), 1, 1e-15);
}

TEST(UrdfModels, CommentsUnknownElementsAndAByteOrderMarkDoNotMatter) {
  const auto robot = recorded(
      "\xef\xbb\xbf<?xml version='1.0' encoding='UTF-8'?>\n<!-- <robot> > ' -->\n<!DOCTYPE robot>\n"
      "<robot name='r' xmlns:xacro='http://ros.org/wiki/xacro'>\n<transmission name='t'><joint "
      "name='x'/></transmission>\n" +
      std::string(body_a) + "<![CDATA[<link name='z'/>]]>\n  <link/></robot>");
  EXPECT_EQ(robot.problems, Lines{"warning 7:3 a link without a name is left out; write <link name=\"...\">"});
}

}  // namespace
}  // namespace muro::urdf
