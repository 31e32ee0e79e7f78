// SPDX-License-Identifier: MIT
// Messages about files that are no models, and about features that are left out.
#include "reading_testing.hpp"

namespace muro::mjcf {
namespace {

/// Returns the only problem of a text from which no robot can be made.
std::string refusal_of(const std::string& text) {
  const Robot robot = robot_of(text);
  EXPECT_FALSE(robot.tree.usable()) << text;
  EXPECT_EQ(robot.problems.size(), 1u) << joined(robot.problems);
  return robot.problems.empty() ? "" : robot.problems[0];
}

TEST(MjcfProblems, OtherFormatsInXmlAreNamed) {
  EXPECT_EQ(refusal_of("<!-- a -->\n<robot name='r'/>"),
            "error 2: the file begins with <robot>, so it is URDF and not MJCF; give it a name that ends in .urdf");
  EXPECT_EQ(refusal_of("<sdf version='1.9'/>"),
            "error 1: the file begins with <sdf>, so it is SDFormat and not MJCF; give it a name that ends in .sdf");
  EXPECT_EQ(refusal_of("<mujocoinclude/>"),
            "error 1: the file begins with <mujocoinclude>: it is a part of a model; name the file that includes it");
  EXPECT_EQ(refusal_of("<html/>"), "error 1: the file begins with <html>; MJCF begins with <mujoco>");
  EXPECT_NE(refusal_of("").find("error"), std::string::npos);
  EXPECT_EQ(refusal_of("<mujoco>\n<worldbody>"),
            "error 2: the file is not well-formed XML: a closing tag does not match the element that is open");
}

TEST(MjcfProblems, WhatMuJoCoRefusesIsToldWithItsLine) {
  EXPECT_NE(refusal_of(mujoco("<bdy/>")).find("error 3: MuJoCo 2."), std::string::npos);
  EXPECT_NE(refusal_of(mujoco("<bdy/>")).find("unrecognized element; Element 'bdy', line 3"), std::string::npos);
  const std::string massless = refusal_of(mujoco("<body name='a'/>\n<body name='b'><joint/></body>"));
  EXPECT_NE(massless.find("error 4: MuJoCo"), std::string::npos) << massless;
  EXPECT_NE(massless.find("mass and inertia of moving bodies must be larger than mjMINVAL"), std::string::npos);
  const std::string lost = refusal_of(mujoco("", "<asset>\n<mesh name='wheel' file='lost.stl'/></asset>"));
  EXPECT_NE(lost.find("error 6: MuJoCo"), std::string::npos) << lost;
  EXPECT_NE(lost.find("could not open STL file '/nowhere/lost.stl'"), std::string::npos) << lost;
  EXPECT_NE(refusal_of("<mujoco>\n<include file='lost.xml'/></mujoco>").find("/nowhere/lost.xml"), std::string::npos);
}

TEST(MjcfProblems, AttributesOfLaterVersionsAreLeftOut) {
  // each attribute is removed alone; line numbers stay, and similar text elsewhere is not changed
  const Robot robot = robot_of(R"(<mujoco>
<option integrator="implicitfast"
  ls_iterations='5' timestep="0.001"><flag eulerdamp="disable"/></option>
<!-- <body gravcomp="1"> -->
<worldbody><body name="kv"
  gravcomp="1"><freejoint align="true"/><geom size="0.1"/>
<body><joint name="j" actuatorfrcrange="-1 1"/><geom size="0.1"/></body></body></worldbody>
<actuator><position joint="j" kp="7" kv="3"/><position name="kv='2'" joint="j" kv="2"/></actuator></mujoco>)");
  EXPECT_TRUE(robot.tree.usable());
  for (const char* line :
       {"note 2: the integrator `implicitfast` is taken as `implicit`",
        "note 3: attribute `ls_iterations` of <option> is left out, since the MuJoCo that muro is built with is older",
        "note 3: attribute `eulerdamp` of <flag>", "note 6: attribute `align` of <freejoint>",
        "warning 6: attribute `gravcomp` of <body> is left out, since the MuJoCo that muro is built with is older: "
        "gravity pulls at the body in full",
        "warning 7: attribute `actuatorfrcrange` of <joint>",
        "warning 8: attribute `kv` of <position> is left out, since the MuJoCo that muro is built with is older: the "
        "servo has no damping",
        "actuator `kv='2'` is left out: it is the second of its joint"})
    EXPECT_TRUE(has_line(robot.problems, line)) << line << "\n" << joined(robot.problems);
  EXPECT_EQ(robot.joint("j")->link.limits.effort, std::numeric_limits<double>::infinity());
}

TEST(MjcfProblems, RangesAreLimitsAsInLaterVersions) {
  const std::string bodies =
      "<worldbody>\n<body name='a'><geom size='0.1'/><body>\n<joint name='j' range='-30 60'/><geom size='0.1'/>"
      "</body></body></worldbody></mujoco>";
  const Robot robot = robot_of("<mujoco model='m'>" + bodies);
  ASSERT_TRUE(robot.tree.usable()) << joined(robot.problems);
  EXPECT_TRUE(has_line(robot.problems, "note 1: a `range` without `limited` is a limit"));
  EXPECT_NEAR(robot.joint("j")->link.limits.lower, -M_PI / 6, 1e-12);
  EXPECT_NEAR(robot.joint("j")->link.limits.upper, M_PI / 3, 1e-12);
  EXPECT_NE(refusal_of("<mujoco><compiler autolimits='false'/>" + bodies).find("autolimits"), std::string::npos)
      << "the file says otherwise";
}

TEST(MjcfProblems, WhatNoVersionKnowsIsAMistake) {
  EXPECT_NE(refusal_of(mujoco("<body>\n<freejoint/><geom sise='0.1'/></body>")).find("unrecognized attribute: 'sise'"),
            std::string::npos);
}

TEST(MjcfProblems, AFileWithoutBodiesIsNoRobot) {
  EXPECT_EQ(refusal_of(mujoco("<geom size='1'/>")),
            "error 0: the file has no <body>; if it is scenery, name it as the scenario's `world: {file: ...}`");
}

TEST(MjcfProblems, BallJointsAreRefusedByName) {
  EXPECT_EQ(robot_of(mujoco("<body name='a'><freejoint/><geom size='1'/>\n<body name='b'>\n<joint name='hip' "
                            "type='ball'/><geom size='1'/></body></body>"))
                .problems.at(0),
            "error 5: joint `hip` of body `b` is a ball, which robots do not have; write three hinges about x, y and z "
            "in its place");
}

TEST(MjcfProblems, WhatIsLeftOutIsListedByName) {
  const Robot robot = robot_of(R"(<mujoco>
<option density="1.2"/>
<asset><hfield name="hills" nrow="2" ncol="2" size="1 1 1 1"/><mesh name="tet" vertex="0 0 0 1 0 0 0 1 0 0 0 1"/></asset>
<worldbody><body name="a"><freejoint/>
<geom name="egg" type="ellipsoid" size="0.1 0.2 0.3"/>
<geom name="pyramid" type="mesh" mesh="tet"/>
<geom name="ball" size="0.2"/>
<site name="s"/>
<body name="b">
<joint name="j" stiffness="3"/>
<geom size="0.1"/></body>
<body name="c"><joint name="k"/><geom size="0.1"/></body></body></worldbody>
<tendon>
<fixed name="cable"><joint joint="j" coef="1"/></fixed></tendon>
<equality>
<joint name="gear" joint1="j" joint2="k"/></equality>
<contact><pair geom1="egg" geom2="ball"/><exclude name="not" body1="a" body2="b"/></contact>
<actuator><motor name="pull" tendon="cable"/><position joint="k"/><motor name="more" joint="k"/><general name="odd" joint="j" dyntype="filter"/></actuator>
<sensor><gyro name="imu" site="s"/></sensor>
<keyframe><key name="home"/></keyframe>
</mujoco>)");
  EXPECT_TRUE(robot.tree.usable());
  for (const char* line : {
           "lost collision 5: geom `egg` is left out: there is no shape `ellipsoid`; take a sphere, a capsule or a "
           "mesh",
           "lost collision 6: geom `pyramid` is left out: mesh `tet` is written in the MJCF itself; save it as .obj or "
           ".stl",
           "warning 10: the stiffness of joint `j` is left out: joints have no springs; motion.mujoco has them with "
           "`settings: model`, elsewhere a controller may act as one",
           "warning 14: tendons `cable` are left out; motion.mujoco has them with `settings: model`",
           "equality constraints `gear` are left out; motion.mujoco has them with `settings: model`",
           "contact pairs `number 1` are left out",
           "exclusions of contact `not` count",
           "actuator `odd` is left out: it is neither a motor nor a position or velocity servo",
           "actuator `pull` is left out: it acts on no joint",
           "actuator `more` is left out: it is the second of its joint",
           "sensors `imu` are left out",
           "keyframes `home` are left out",
           "density, viscosity and wind",
       })
    EXPECT_TRUE(has_line(robot.problems, line)) << line << "\n" << joined(robot.problems);
}

}  // namespace
}  // namespace muro::mjcf
