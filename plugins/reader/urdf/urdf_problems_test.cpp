// SPDX-License-Identifier: MIT
// Every mistake is reported completely, with its location, and all mistakes of a file at once.
#include <gtest/gtest.h>

#include <clocale>
#include <locale>

#include "recording_builder.hpp"

namespace muro::urdf {
namespace {

using Lines = std::vector<std::string>;

/// Returns the problems of a robot with body `a` in line 2; `more` begins at line 3, column 1.
Lines problems_of(const std::string& more) {
  return recorded("<robot name='r'>\n" + std::string(body_a) + "\n" + more + "\n</robot>").problems;
}
/// Returns the problems of a robot with a second body `b` in line 3; `joint` begins at line 4.
Lines joint_problems(const std::string& joint) { return problems_of(std::string(link_b) + "\n" + joint); }
/// Returns a joint between the two bodies, with the elements `inside`.
std::string joint(const std::string& type, const std::string& inside) {
  return "<joint name='j' type='" + type + "'><parent link='a'/><child link='b'/>" + inside + "</joint>";
}
/// Returns a link `b`, fixed to `a`, with the elements `inside`; it is in line 3.
std::string link(const std::string& inside) {
  return "<link name='b'>" + inside + "</link><joint name='j' type='fixed'><parent link='a'/><child link='b'/></joint>";
}
std::string inertial(const std::string& mass, const std::string& inertia) {
  return "<inertial><mass value='" + mass + "'/><inertia " + inertia + "/></inertial>";
}
constexpr char limit[] = "<limit lower='-1' upper='1' velocity='1' effort='1'/>";

TEST(UrdfProblems, FilesThatAreNoXml) {
  EXPECT_EQ(recorded("").problems, Lines{"error 0:0 the file is empty; a URDF file holds a <robot> element"});
  EXPECT_EQ(recorded(" \n\t\n").problems, Lines{"error 0:0 the file is empty; a URDF file holds a <robot> element"});
  EXPECT_EQ(recorded("\nsolid wheel").problems,
            Lines{"error 2:1 the file is not XML; a URDF file begins with <?xml or <robot"});
  EXPECT_EQ(recorded("<robot name='r'>\n<link name='a'>\n</robot>").problems,
            Lines{"error 2:0 the file is not well-formed XML: a closing tag does not match the element that is open"});
  EXPECT_EQ(recorded("<robot name='r'>\n<!-- ").problems,
            Lines{"error 2:0 the file is not well-formed XML: a comment <!-- is not closed by -->"});
  EXPECT_EQ(recorded("<robot name='r'").problems,
            Lines{"error 1:0 the file is not well-formed XML: an element's tag is not written correctly"});
  EXPECT_EQ(recorded(std::string("<robot>\0</robot>", 16)).problems,
            Lines{"error 1:8 the file holds a zero byte: it is no text file, or cut, or not UTF-8"});
  EXPECT_EQ(recorded("\xff\xfe<").problems, Lines{"error 1:1 the file is encoded as UTF-16; save it as UTF-8"});
  EXPECT_EQ(
      recorded("<?xml version='1.0'?>\n<sdf version='1.6'/>").problems,
      Lines{"error 2:1 the file holds no <robot> element, but `sdf`; a URDF file is <robot name=\"...\"> with links "
            "and joints"});
  EXPECT_EQ(recorded("<robot name='r'/>").problems,
            Lines{"error 1:1 the robot has no link; it needs at least one <link name=\"...\"/>"});
}

TEST(UrdfProblems, TextThatIsNotUtf8IsReadAsLatin1) {
  const auto robot = recorded(
      "<robot name='r'>\n<!-- R\xe4"
      "der -->" +
      std::string(body_a) + "</robot>");
  EXPECT_EQ(robot.problems,
            Lines{"warning 2:7 byte 228 is not UTF-8; the file is read as ISO-8859-1. Save it as UTF-8"});
  EXPECT_EQ(robot.calls, Lines{"base a"});
}

TEST(UrdfProblems, XacroThatWasNotRun) {
  const std::string advice = "run `xacro FILE -o model.urdf` (of ROS, or from `pip install xacro`) and read model.urdf";
  EXPECT_EQ(problems_of("<link name='b'><visual><geometry><sphere radius='${r}'/></geometry></visual></link>"),
            Lines{"error 3:34 the file is xacro source, not URDF: `${r}` is left in; " + advice});
  EXPECT_EQ(recorded("<robot name='r'>\n<xacro:include filename='$(find x)/y.xacro'/></robot>").problems,
            Lines{"error 2:1 the file is xacro source, not URDF: `<xacro:include>` is left in; " + advice});
}

TEST(UrdfProblems, XacroThatHasLeftSomethingBehind) {
  const auto robot = recorded("<robot name='r'>\n" + std::string(body_a) +
                              "\n<xacro:wheel name='${n}'><link name='b'/></xacro:wheel><xacro:wheel/></robot>");
  EXPECT_EQ(
      robot.problems,
      Lines{"warning 3:1 `<xacro:wheel>` of xacro is left in, and 1 more; it is left out. If what it stands for is "
            "missing, run `xacro FILE -o model.urdf` (of ROS, or from `pip install xacro`) and read model.urdf"});
  EXPECT_EQ(robot.calls, Lines{"base a"});
}

TEST(UrdfProblems, ADeclarationThatIsNotFirstIsIgnored) {
  const auto robot =
      recorded("<!-- made by xacro -->\n  <?xml version='1.0'?>\n<robot name='r'>" + std::string(body_a) + "</robot>");
  EXPECT_EQ(robot.problems, Lines{"note 2:3 the declaration <?xml ... ?> is ignored here; it belongs at the very "
                                  "beginning of the file"});
  EXPECT_EQ(robot.calls, Lines{"base a"});
}

TEST(UrdfProblems, RobotsWithoutNameOrOfAnotherVersion) {
  EXPECT_EQ(recorded("<robot version='2.0'>" + std::string(body_a) + "</robot>").problems,
            (Lines{"warning 1:1 <robot> has no name; write <robot name=\"...\">",
                   "warning 1:1 the file is of URDF version `2.0` and is read as version 1.0"}));
}

TEST(UrdfProblems, NumbersThatAreNone) {
  const auto of_radius = [](const std::string& radius) {
    return problems_of(link("<collision><geometry><sphere radius='" + radius + "'/></geometry></collision>"));
  };
  const auto wrong = [](const std::string& text) {
    return Lines{"lost collision 3:37 link `b`, <sphere radius>: " + text + "; the <collision> is left out"};
  };
  EXPECT_EQ(of_radius("1,5"), wrong("`1,5` is no number; the decimal sign is a point, and blanks separate numbers"));
  EXPECT_EQ(of_radius("big"), wrong("`big` is no number; write it like 0.05 or 5e-2"));
  EXPECT_EQ(of_radius("0x10"), wrong("`0x10` is no number; write it like 0.05 or 5e-2"));
  EXPECT_EQ(of_radius("nan"), wrong("`nan` is not finite"));
  EXPECT_EQ(of_radius("-inf"), wrong("`-inf` is not finite"));
  EXPECT_EQ(of_radius("1e999"), wrong("`1e999` is out of the range of a number; the largest is 1.8e308"));
  EXPECT_EQ(of_radius(""), wrong("`` has 0 numbers, and needs 1"));
  EXPECT_EQ(of_radius("1 2"), wrong("`1 2` has 2 numbers, and needs 1"));
  EXPECT_EQ(of_radius("%s%n"), wrong("`%s%n` is no number; write it like 0.05 or 5e-2"));
  EXPECT_EQ(
      problems_of(link("<collision><origin xyz='1 2'/><geometry><sphere radius='1'/></geometry></collision>")),
      Lines{"lost collision 3:27 link `b`, <origin xyz>: `1 2` has 2 numbers, and needs 3 separated by blanks; the "
            "<collision> is left out"});
  EXPECT_EQ(joint_problems(joint("fixed", "<origin xyz='1 2'/>")),
            Lines{"error 4:65 joint `j`, <origin xyz>: `1 2` has 2 numbers, and needs 3 separated by blanks"});
}

TEST(UrdfProblems, LinksWithoutNameOrWithTheNameOfAnother) {
  EXPECT_EQ(problems_of("<link/><link name=''/>"),
            (Lines{"warning 3:1 a link without a name is left out; write <link name=\"...\">",
                   "warning 3:8 a link without a name is left out; write <link name=\"...\">"}));
  EXPECT_EQ(problems_of("\n  <link name='a'/>"),
            Lines{"warning 4:3 a second link named `a` is left out; the first one is in line 2, and names are unique"});
}

TEST(UrdfProblems, MassesThatNoBodyHas) {
  const std::string unit = "ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='1'";
  EXPECT_EQ(problems_of(link(inertial("-1", unit))),
            Lines{"warning 3:26 link `b`: the mass is -1 kg and taken as 0, a frame without a body; it is 0 or more"});
  EXPECT_EQ(problems_of(link(inertial("0", unit))),
            Lines{"warning 3:16 link `b` has an inertia but no mass; the inertia is ignored"});
  EXPECT_EQ(problems_of(link("<inertial/>")),
            Lines{"warning 3:16 link `b`: <inertial> without <mass value=\"...\"/>; the link has no mass"});
  EXPECT_EQ(problems_of(link("<inertial/><inertial/>")),
            (Lines{"warning 3:27 link `b` has 2 <inertial> elements; only the first one counts",
                   "warning 3:16 link `b`: <inertial> without <mass value=\"...\"/>; the link has no mass"}));
  EXPECT_EQ(problems_of(link(inertial("1", "ixx='1' iyy='1' izz='1'"))),
            Lines{"warning 3:43 link `b`: <inertia> lacks ixy, ixz, iyz, which count as 0"});
  EXPECT_EQ(recorded("<robot name='r'>\n<link name='a'/></robot>").problems,
            Lines{"warning 2:1 no link has a mass; only motion without forces can move the robot"});
}

TEST(UrdfProblems, InertiasThatNoBodyHas) {
  EXPECT_EQ(
      problems_of(link(inertial("1", "ixx='1' ixy='0' ixz='0' iyy='1' iyz='0' izz='3'"))),
      Lines{"warning 3:1 link `b`: its principal moments of inertia are 1 1 3 kg m^2, which no body has: none exceeds "
            "the sum of the other two. They are used as they are"});
  const auto robot =
      recorded("<robot name='r'>\n<link name='a'>" + inertial("2", "ixx='0' ixy='0' ixz='0' iyy='0' iyz='0' izz='0'") +
               "<collision><geometry><box size='1 2 3'/></geometry></collision></link></robot>");
  EXPECT_EQ(
      robot.problems,
      Lines{"warning 2:1 link `a`: its principal moments of inertia are 0 0 0 kg m^2, and the least must be above 1e-9 "
            "times the greatest; those of its "
            "shapes with uniform density and 2 kg are used: 2.1666666666666665 1.6666666666666665 0.8333333333333333"});
  EXPECT_NEAR(robot.inertials.at("a").ixx, 2 * (4 + 9) / 12.0, 1e-12);
}

TEST(UrdfProblems, AnInertiaBeyondAllBodies) {
  const Lines problems =
      problems_of(link("<inertial><origin rpy='1 1 1'/><mass value='1'/><inertia ixx='1e308' ixy='1e308' ixz='1e308' "
                       "iyy='1e308' iyz='1e308' izz='1e308'/></inertial>"));
  ASSERT_EQ(problems.size(), 6u);
  EXPECT_EQ(problems[0],
            "warning 3:64 link `b`, <inertia ixx>: `1e308` has a number beyond 1e+21 kg m^2; the link has no mass");
}

TEST(UrdfProblems, ShapesThatAreLeftOut) {
  const auto of = [](const std::string& geometry) {
    return problems_of(link("<collision>" + geometry + "</collision>"));
  };
  EXPECT_EQ(of(""), Lines{"lost collision 3:16 link `b`: a <collision> is left out, as it has no shape in <geometry>"});
  EXPECT_EQ(of("<geometry/>"),
            Lines{"lost collision 3:16 link `b`: a <collision> is left out, as it has no shape in <geometry>"});
  EXPECT_EQ(of("<geometry><cone/></geometry>"),
            Lines{"lost collision 3:37 link `b`: a <collision> is left out, as `cone` is no "
                  "shape of URDF: box, capsule, cylinder, sphere, mesh"});
  EXPECT_EQ(of("<geometry><box/></geometry>"),
            Lines{"lost collision 3:37 link `b`: a <collision> is left out, as its <box> has no size"});
  EXPECT_EQ(
      of("<geometry><box size='1 0 1'/></geometry>"),
      Lines{"lost collision 3:37 link `b`: a <collision> is left out, as its <box> has a size that is not above 0"});
  EXPECT_EQ(
      of("<geometry><sphere radius='1'/><sphere radius='2'/></geometry>"),
      Lines{
          "warning 3:27 link `b`: <geometry> holds several shapes; only the first one counts. Give each a <collision> "
          "of its own"});
}

TEST(UrdfProblems, MeshesThatAreNotThereAreToldOnceWhereTheyAreNamed) {
  const std::string file = "<geometry>\n<mesh filename='file:///no/where.stl'/></geometry>",
                    collision = "<collision>" + file + "</collision>", visual = "<visual>" + file + "</visual>";
  const std::string touched = ", so that nothing touches the links there";
  const std::string looked = "; looked for /no/where.stl; correct its path";
  EXPECT_EQ(problems_of(link(visual)),
            Lines{"warning 4:1 mesh `file:///no/where.stl` is not found and left out" + looked});
  EXPECT_EQ(problems_of(link(collision)),
            Lines{"lost collision 4:1 mesh `file:///no/where.stl` is not found and left out" + touched + looked});
  EXPECT_EQ(problems_of(link(visual + collision + visual)),
            Lines{"lost collision 4:1 mesh `file:///no/where.stl` (also in lines 5, 6) is not found and left out" +
                  touched + looked});
  EXPECT_EQ(
      problems_of(link(visual + "<visual><geometry><mesh filename='m/x.STL'/></geometry></visual>")),
      Lines{"warning 4:1 meshes `file:///no/where.stl`, `m/x.STL` in line 4 are not found and left out" + looked});
  EXPECT_EQ(problems_of(link("<collision><geometry><mesh filename='m/x.STL'/></geometry></collision>")),
            Lines{"lost collision 3:37 mesh `m/x.STL` is not found and left out" + touched +
                  "; looked for /nowhere/m/x.STL; correct its path"});
  const Lines in_package =
      problems_of(link("<collision><geometry><mesh filename='package://arm/x.stl'/></geometry></collision>"));
  ASSERT_EQ(in_package.size(), 1u);
  EXPECT_TRUE(
      in_package[0].ends_with("; package `arm` is unknown: add the folder that holds it to ROS_PACKAGE_PATH, or write "
                              "`packages: {arm: FOLDER}` in the scenario"))
      << in_package[0];
}

TEST(UrdfProblems, MaterialsThatShowNoColour) {
  const auto of = [](const std::string& material) {
    return problems_of(link("<visual><geometry><sphere radius='1'/></geometry>" + material + "</visual>"));
  };
  EXPECT_EQ(
      of("<material name='%s%s%n'/>"),
      Lines{"warning 3:65 link `b`: material `%s%s%n` is not defined; it is grey. Give it a <color rgba=\"...\"/>"});
  EXPECT_EQ(
      of("<material name='m'><color rgba='255 0 0 1'/></material>"),
      Lines{"warning 3:84 link `b`: colour `255 0 0 1` is read as `1 0 0 1`; red, green, blue and alpha are between 0 "
            "and 1"});
  EXPECT_EQ(of("<material name='m'><color/></material>").front(),
            "warning 3:84 link `b`: <color> has no rgba=\"red green blue alpha\" and is ignored");
  EXPECT_EQ(problems_of("<material name='m'><color rgba='1 1 1 1'/></material><material name='m'/>"),
            Lines{"warning 3:54 material `m` is defined twice; the first definition is used"});
  EXPECT_EQ(problems_of("<material name='m'><texture/></material>"),
            Lines{"warning 3:20 material `m`: <texture> has no filename=\"...\" and is ignored"});
}

TEST(UrdfProblems, JointsWithoutTheirParts) {
  const std::string attached =
      "warning 3:1 no joint leads to link `b`; it is fixed to the origin of the root, link `a`, on which most others "
      "hang. Join them to it where they belong";
  EXPECT_EQ(joint_problems("<joint type='fixed'><parent link='a'/><child link='b'/></joint>"),
            Lines{"warning 4:1 a joint has no name and is called `b_joint`; write <joint name=\"...\" type=\"...\">"});
  EXPECT_EQ(joint_problems("<joint name='j'><child link='b'/></joint>"),
            (Lines{"warning 4:1 joint `j` is left out: it has no parent; write <parent link=\"...\"/>", attached}));
  EXPECT_EQ(joint_problems(joint("ball", "")),
            Lines{"warning 4:1 joint `j` is of the unknown type `ball` and taken as fixed; types are fixed, revolute, "
                  "continuous, prismatic, planar, floating"});
  EXPECT_EQ(joint_problems("<joint name='j' type='fixed'><parent link='chassis'/><child link='b'/></joint>"),
            (Lines{"warning 4:30 joint `j` is left out: its parent, link `chassis`, does not exist; links are `a`, `b`",
                   attached}));
  EXPECT_EQ(joint_problems("<joint name='j' type='fixed'><parent link='a'/><child link='a'/></joint>"),
            (Lines{"warning 4:1 joint `j` is left out: it joins link `a` with itself", attached}));
  EXPECT_EQ(
      joint_problems(joint("fixed", "") + "<link name='c'/>"
                                          "<joint name='j' type='fixed'><parent link='a'/><child link='c'/></joint>"),
      Lines{"warning 4:89 a second joint is named `j` and called `j_2`; the first one is in line 4, and names are "
            "unique"});
}

TEST(UrdfProblems, AxesWithoutDirectionOrUnitLength) {
  EXPECT_EQ(
      joint_problems(joint("continuous", "<axis xyz='0 0 0'/>")),
      Lines{"warning 4:70 joint `j`: axis `0 0 0` has no direction, so that the joint is taken as fixed; an axis is a "
            "vector of length 1, such as 0 0 1"});
  EXPECT_EQ(joint_problems(joint("continuous", "<axis xyz='0 0 2'/>")),
            Lines{"note 4:70 joint `j`: axis `0 0 2` is not of length 1; only its direction is used"});
  EXPECT_EQ(joint_problems(joint("continuous", "<axis/>")),
            Lines{"warning 4:70 joint `j`: <axis> has no xyz; the axis is x, URDF's default"});
  EXPECT_EQ(joint_problems(joint("fixed", "<axis xyz='0 0 0'/>")), Lines{});
}

TEST(UrdfProblems, LimitsThatAreMissingOrOdd) {
  EXPECT_EQ(joint_problems(joint("revolute", "")),
            Lines{"warning 4:1 joint `j` is revolute but has no <limit>; it is unlimited. Write <limit lower=\"...\" "
                  "upper=\"...\" velocity=\"...\" effort=\"...\"/>"});
  EXPECT_EQ(joint_problems(joint("prismatic", "<limit lower='1' upper='-1' velocity='1' effort='1'/>")),
            Lines{"warning 4:69 joint `j`: lower limit 1 is above upper limit -1; the two are exchanged"});
  EXPECT_EQ(
      joint_problems(joint("revolute", "<limit velocity='1' effort='1'/>")),
      Lines{
          "warning 4:68 joint `j`: lower and upper limits are both 0; the joint cannot move. Give a range, or make it "
          "fixed"});
  EXPECT_EQ(joint_problems(joint("revolute", "<limit lower='0' upper='1' effort='-5'/>")),
            (Lines{"warning 4:68 joint `j`: <limit> has no velocity, which is taken as unlimited",
                   "warning 4:68 joint `j`: its effort limit -5 is negative and taken as unlimited; it is 0 or more"}));
  EXPECT_EQ(
      joint_problems(joint("revolute", "<limit lower='0' upper='1' effort='1' velocity='0'/>")),
      Lines{"warning 4:68 joint `j`: its velocity limit is 0, so that no drive can move it; leave velocity out when it "
            "is unknown"});
  EXPECT_EQ(joint_problems(joint("continuous", limit)),
            Lines{"note 4:70 joint `j` is continuous: its lower and upper limits are ignored"});
  EXPECT_EQ(joint_problems(joint("continuous", "<dynamics damping='-1'/>")),
            Lines{"warning 4:70 joint `j`: damping -1 is negative and taken as 0"});
}

TEST(UrdfProblems, RotorsThatAreNone) {
  EXPECT_EQ(joint_problems(joint("continuous", "<dynamics armature='-1'/>")),
            Lines{"warning 4:70 joint `j`: armature -1 is negative and taken as 0"});
  const auto problems_of_rotor = [](const std::string& transmission, const std::string& dynamics = "") {
    return joint_problems(joint("continuous", dynamics) + "\n<transmission>" + transmission + "</transmission>");
  };
  const std::string rotor = "<actuator name='m'><drake:rotor_inertia value='2e-5'/></actuator>";
  EXPECT_EQ(problems_of_rotor("<joint name='j'/>" + rotor), Lines{});
  EXPECT_EQ(problems_of_rotor("<joint name='k'/>" + rotor),
            Lines{"warning 5:1 actuator `m` moves no single joint of the robot; the inertia of its rotor is left out"});
  EXPECT_EQ(problems_of_rotor("<joint name='j'/><actuator name='m'><drake:rotor_inertia/></actuator>"),
            Lines{"warning 5:51 actuator `m`, <drake:rotor_inertia>: write value=\"...\" with a number from 0 to 1e7; "
                  "the inertia of its rotor is left out"});
  EXPECT_EQ(problems_of_rotor("<joint name='j'/><actuator name='m'><drake:rotor_inertia value='-1'/></actuator>"),
            Lines{"warning 5:51 actuator `m`, <drake:rotor_inertia>: write value=\"...\" with a number from 0 to 1e7; "
                  "the inertia of its rotor is left out"});
  EXPECT_EQ(problems_of_rotor("<joint name='j'/>" + rotor, "<dynamics armature='0.5'/>"),
            Lines{"warning 5:32 actuator `m`: its rotor is 2e-05 at the joint, whose <dynamics> has the armature 0.5; "
                  "that of <dynamics> counts"});
}

TEST(UrdfProblems, RotorsOfDrivesAreReadAsOtherProgramsWriteThem) {
  const auto armature = [](const std::string& dynamics, const std::string& more = "") {
    const auto robot =
        recorded("<robot name='r'>" + std::string(body_a) + link_b + joint("continuous", dynamics) + more + "</robot>");
    EXPECT_EQ(robot.problems, Lines{});
    return robot.limits.at("j").armature;
  };
  const auto transmission = [](const std::string& actuator) {
    return "<transmission><type>SimpleTransmission</type><joint name='j'/><actuator name='m'>" + actuator +
           "</actuator></transmission>";
  };
  EXPECT_EQ(armature(""), 0);
  EXPECT_EQ(armature("<dynamics armature='0.592'/>"), 0.592);
  EXPECT_EQ(armature("<dynamics damping='1' armature='0.012'/>"), 0.012);
  EXPECT_EQ(armature("", transmission("<drake:rotor_inertia value='1.5'/>")), 1.5);
  EXPECT_EQ(armature("", transmission("<drake:rotor_inertia value='1.5'/><drake:gear_ratio value='300'/>")),
            1.5 * 300 * 300);
  EXPECT_EQ(armature("", transmission("<mechanicalReduction>50</mechanicalReduction>")), 0);
}

TEST(UrdfProblems, UnlimitedIsInfinite) {
  const double infinity = std::numeric_limits<double>::infinity();
  const auto robot = recorded("<robot name='r'>" + std::string(body_a) + link_b + joint("prismatic", "") + "</robot>");
  const JointLimits& limits = robot.limits.at("j");
  EXPECT_EQ(limits.lower, -infinity);
  EXPECT_EQ(limits.upper, infinity);
  EXPECT_EQ(limits.velocity, infinity);
  EXPECT_EQ(limits.effort, infinity);
}

TEST(UrdfProblems, MimicsThatFollowNobody) {
  EXPECT_EQ(
      joint_problems(joint("continuous", "<mimic joint='nobody'/>")),
      Lines{"warning 4:70 joint `j` mimics `nobody`, which is no revolute, continuous or prismatic joint; it moves on "
            "its own"});
  EXPECT_EQ(joint_problems(joint("fixed", "<mimic joint='j'/>")),
            Lines{"warning 4:65 joint `j` is fixed and cannot mimic; <mimic> is ignored"});
  EXPECT_EQ(joint_problems(joint("continuous", "<mimic joint='j'/>")),
            Lines{"warning 4:70 joint `j` mimics itself, over 0 other joints; it moves on its own"});
}

TEST(UrdfProblems, LeadersThatTakeMimicsBeyondTheirLimits) {
  // keeps messages about mimic joints only: these links also have no mass
  const auto problems = [](const std::string& follower) {
    Lines all = recorded(
                    "<robot name='r'><link name='a'/><link name='b'/><link name='c'/>"
                    "<joint name='one' type='revolute'><parent link='a'/><child link='b'/>"
                    "<limit lower='0' upper='0.8' velocity='1' effort='1'/></joint>\n"
                    "<joint name='two' type='" +
                    follower + "</joint></robot>")
                    .problems;
    std::erase_if(all, [](const std::string& text) { return text.find("mimics") == text.npos; });
    return all;
  };
  const std::string links = "'><parent link='a'/><child link='c'/>", mimic = "<mimic joint='one' multiplier='-1'/>";
  const auto bounded = [](const std::string& bounds) { return "<limit " + bounds + " velocity='1' effort='1'/>"; };
  EXPECT_EQ(problems("revolute" + links + bounded("lower='0' upper='0.88'") + mimic),
            Lines{"warning 2:125 joint `two` mimics `one`, which takes it from -0.8 to 0, beyond its own limits 0 to "
                  "0.88; it goes there, since mimic joints have the limits of their leaders alone. Mend multiplier, "
                  "offset or limits"});
  EXPECT_EQ(problems("revolute" + links + bounded("lower='-0.8' upper='0'") + mimic), Lines{});
  EXPECT_EQ(problems("continuous" + links + mimic), Lines{});
}

TEST(UrdfProblems, SeveralRootsBecomeOneThatHoldsTheOthers) {
  const auto robot = recorded("<robot name='r'>\n<link name='c'/>\n" + std::string(body_a) + link_b +
                              joint("continuous", "<origin xyz='1 0 0'/>") + "</robot>");
  EXPECT_EQ(robot.problems, Lines{"warning 2:1 no joint leads to link `c`; it is fixed to the origin of the root, link "
                                  "`a`, on which most others hang. Join them to it where they belong"});
  EXPECT_EQ(robot.calls,
            (Lines{"base a", "fork", "translation 1 0 0", "revolute j about 1 0 0", "body b", "end", "body c", "end"}));
}

TEST(UrdfProblems, ChainsAreCutWhereTheyClose) {
  const auto loop = recorded("<robot name='r'>\n" + std::string(body_a) + link_b + "\n" + joint("fixed", "") +
                             "<joint name='k' type='fixed'><parent link='b'/><child link='a'/></joint></robot>");
  EXPECT_EQ(loop.problems, Lines{"warning 3:73 joint `k` closes a loop and is left out: link `a`, to which it leads, "
                                 "would be its own descendant"});
  EXPECT_EQ(loop.calls, (Lines{"base a", "body b"}));
  const auto twice = recorded("<robot name='r'>\n" + std::string(body_a) + link_b + "\n" + joint("fixed", "") +
                              "<joint name='k' type='fixed'><parent link='a'/><child link='b'/></joint></robot>");
  EXPECT_EQ(twice.problems,
            Lines{"warning 3:73 joint `k` closes a chain and is left out: its child, link `b`, hangs on "
                  "joint `j` already, and what moves has one parent"});
  EXPECT_EQ(twice.calls, (Lines{"base a", "body b"}));
}

TEST(UrdfProblems, OneNameForALinkAndAJoint) {
  const auto robot = recorded("<robot name='r'>\n" + std::string(body_a) + link_b +
                              "<joint name='b' type='continuous'><parent link='a'/><child link='b'/></joint></robot>");
  EXPECT_EQ(robot.problems, Lines{"note 2:237 joint `b` has the name of a link; it is called `b_joint`"});
  EXPECT_EQ(robot.calls, (Lines{"base a", "revolute b_joint about 1 0 0", "body b"}));
}

TEST(UrdfProblems, FloatingJointsAreFixed) {
  EXPECT_EQ(
      joint_problems(joint("floating", "")),
      Lines{"warning 4:1 joint `j` is floating and taken as fixed; link `b` and what hangs on it move freely only as a "
            "robot of their own"});
  EXPECT_EQ(
      recorded("<robot name='r'>\n<link name='world'/>" + std::string(body_a) +
               "<joint name='j' type='floating'><parent link='world'/><child link='a'/></joint></robot>")
          .problems,
      Lines{"note 2:139 joint `j` is floating and joins the robot to the empty root `world`; it is fixed, as the base "
            "of a robot moves anyway"});
}

TEST(UrdfProblems, ARobotThatIsFixedToTheWorldByItsModelAlone) {
  const auto fixed_to = [](const std::string& root) {
    return recorded("<robot name='r'>\n<link name='" + root + "'/>" + std::string(body_a) +
                    "<joint name='j' type='fixed'><parent link='" + root + "'/><child link='a'/></joint></robot>")
        .problems;
  };
  EXPECT_EQ(fixed_to("world"),
            Lines{"note 2:139 joint `j` fixes the robot to the empty root `world`, which is its base and can move; a "
                  "motion by forces holds it with `base: fixed`"});
  EXPECT_EQ(fixed_to("base_footprint"), Lines{});
}

TEST(UrdfProblems, AMovingLinkWithoutMass) {
  EXPECT_EQ(
      problems_of("<link name='b'/><joint name='j' type='continuous'><parent link='a'/><child link='b'/></joint>"),
      Lines{"warning 3:1 link `b` hangs on a moving joint but has no mass; a motion by forces needs an <inertial> "
            "there"});
}

TEST(UrdfProblems, SurfacesOfGazebo) {
  EXPECT_EQ(
      problems_of("<gazebo reference='a'><mu1>0.8</mu1><mu2>0.5</mu2></gazebo>"),
      Lines{"note 3:1 link `a`: mu1 is 0.8 and mu2 is 0.5; friction is the same in all directions, and mu1 is used"});
  EXPECT_EQ(problems_of("<gazebo reference='a'><mu1>-1</mu1></gazebo>"),
            Lines{"warning 3:1 link `a`: mu1 -1 is ignored; it is from 0 to 1e20"});
  EXPECT_EQ(problems_of("<gazebo reference='a'><restitution_coefficient>2</restitution_coefficient></gazebo>"),
            Lines{"warning 3:1 link `a`: restitution_coefficient 2 is ignored; it is between 0 and 1"});
  EXPECT_EQ(problems_of("<gazebo reference='a'><mu1>much</mu1></gazebo>"),
            Lines{"warning 3:23 link `a`, <mu1>: `much` is no single number and is ignored"});
  EXPECT_EQ(problems_of("<gazebo reference='wheel'><mu1>1</mu1></gazebo>"),
            Lines{"warning 3:1 <gazebo reference=`wheel`> names no link or joint and is ignored"});
}

TEST(UrdfProblems, AllMistakesOfAFileAreToldAtOnceAndAnErrorBuildsNothing) {
  const auto robot = recorded(
      "<robot name='r'>\n<link name='a'/>\n<link name='a'/>\n<link name='b'/><joint name='j' type='hinge'>\n<parent "
      "link='a'/>\n<child link='b'/>\n<origin xyz='1 0'/></joint>\n</robot>");
  EXPECT_EQ(
      robot.problems,
      (Lines{"warning 3:1 a second link named `a` is left out; the first one is in line 2, and names are unique",
             "warning 4:17 joint `j` is of the unknown type `hinge` and taken as fixed; types are fixed, revolute, "
             "continuous, prismatic, planar, floating",
             "error 7:1 joint `j`, <origin xyz>: `1 0` has 2 numbers, and needs 3 separated by blanks"}));
  EXPECT_EQ(robot.calls, Lines{});
}

/// A locale with a comma as decimal sign, available on every machine.
class CommaPunctuation final : public std::numpunct<char> {
  char do_decimal_point() const override { return ','; }
  char do_thousands_sep() const override { return '.'; }
  std::string do_grouping() const override { return "\3"; }
};

TEST(UrdfProblems, NumbersAreReadAlikeInALocaleWithCommas) {
  const std::locale before = std::locale::global(std::locale(std::locale(), new CommaPunctuation));
  const auto robot =
      recorded("<robot name='r'><link name='a'>" +
               inertial("1234.5", "ixx='1e-2' ixy='0' ixz='0' iyy='1e-2' iyz='0' izz='1e-2'") + "</link></robot>");
  std::locale::global(before);
  EXPECT_EQ(robot.problems, Lines{});
  EXPECT_EQ(robot.inertials.at("a").mass, 1234.5);
  EXPECT_EQ(robot.inertials.at("a").ixx, 0.01);
}

}  // namespace
}  // namespace muro::urdf
