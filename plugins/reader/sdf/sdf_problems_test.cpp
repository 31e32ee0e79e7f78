// SPDX-License-Identifier: MIT
// Every mistake is reported completely, with its location, and all mistakes of a file at once.
#include <gtest/gtest.h>

#include <clocale>

#include "reading_testing.hpp"

namespace muro::sdf {
namespace {

using test::ScratchFolder;

Lines problems_of(const std::string& inside) { return robot_of(model(inside)).problems; }

TEST(SdfProblems, FilesThatAreNoSdformat) {
  EXPECT_EQ(robot_of("").problems, Lines{"error 0:0 the file is empty; a SDFormat file holds a <sdf> element"});
  EXPECT_EQ(robot_of("\nsolid x").problems,
            Lines{"error 2:1 the file is not XML; a SDFormat file begins with <?xml or <sdf"});
  EXPECT_EQ(robot_of("<sdf version='1.9'>\n<model name='m'>\n</sdf>").problems,
            Lines{"error 2:0 the file is not well-formed XML: a closing tag does not match the element that is open"});
  EXPECT_EQ(robot_of("<robot name='r'/>").problems,
            Lines{"error 1:1 the file holds no <sdf> element, but `robot`; it is URDF, so give it the ending .urdf; an "
                  "SDFormat file is <sdf "
                  "version=\"1.9\"> with a <model> or a <world>"});
  EXPECT_EQ(robot_of("<sdf/>").problems, Lines{"error 1:1 <sdf> has no version; write <sdf version=\"1.9\">"});
  for (const char* version : {"1.1", "1.0", "", "x", "-1.9", "1e9.5"})
    EXPECT_EQ(robot_of(model(link("a"), version)).problems,
              Lines{"error 1:1 the file is of SDFormat `" + std::string(version) +
                    "`; versions 1.2 to 1.9 are read. `gz sdf -p FILE` of Gazebo converts older ones"});
  EXPECT_EQ(robot_of("<sdf version='1.9'/>").problems, Lines{"error 1:1 the file holds no <model>"});
}

TEST(SdfProblems, NumbersThatAreNone) {
  const auto of = [](const std::string& size) {
    return problems_of(
        link("a", "<collision name='c'>\n<geometry><box><size>" + size + "</size></box></geometry></collision>"));
  };
  EXPECT_EQ(of("1 1"), Lines{"error 4:16 <size>: `1 1` has 2 numbers, and needs 3 separated by blanks"});
  EXPECT_EQ(of("1 1 big"), Lines{"error 4:16 <size>: `1 1 big` is no number; write it like 0.05 or 5e-2"});
  EXPECT_EQ(of("1 1 1,5"), Lines{"warning 4:16 <size>: `1 1 1,5` is no number; the decimal sign is a point, and blanks "
                                 "separate numbers. It is read as `1 1 1`"});
  EXPECT_EQ(
      of("1 1 1 1"),
      Lines{"warning 4:16 <size>: `1 1 1 1` has 4 numbers, and needs 3 separated by blanks. It is read as `1 1 1`"});
  EXPECT_EQ(of("1 1 nan"), (Lines{"warning 4:16 <size>: `1 1 nan` is not finite; it is left out",
                                  "lost collision 4:11 <collision name=`c`> is left out, as its <box> has no <size>"}));
  EXPECT_EQ(problems_of("<static>maybe</static>" + link("a")),
            Lines{"error 3:1 <static>: `maybe` is none of true, false, 1, 0"});
}

TEST(SdfProblems, NumbersAreReadAlikeInEveryLocale) {
  if (!std::setlocale(LC_NUMERIC, "de_DE.UTF-8") && !std::setlocale(LC_NUMERIC, "fr_FR.UTF-8")) return;
  const Robot robot =
      robot_of(model(link("a") + link("b", "<pose>0.5 0 0 0 0 0</pose>") + joint("j", "fixed", "a", "b")));
  std::setlocale(LC_NUMERIC, "C");
  EXPECT_EQ(robot.pose("b").position.x(), 0.5);
}

TEST(SdfProblems, NamesThatAreMissingTwiceThereOrUnknown) {
  const std::string base = "warning 4:1 no joint leads to link `";
  EXPECT_EQ(
      problems_of("<link/>" + link("a") + link("b") +
                  "\n<joint type='fixed'><parent>a</parent><child>b</child></joint>"),
      (Lines{"warning 3:1 a link without a name is left out; write <link name=\"...\">",
             "warning 4:1 a joint without a name is left out; write <joint name=\"...\">",
             "warning 3:" + std::to_string(1 + std::string("<link/>").size() + link("a").size()) +
                 " no joint leads to link `b`; it is fixed to the base, link `a`. What is to move freely is a model of "
                 "its own"}));
  EXPECT_EQ(
      problems_of(link("a") + "\n" + link("a")),
      (Lines{"warning 4:1 a link has the name `a` of the link in line 3 and is called `a_2`; names are unique within a "
             "model",
             base + "a_2`; it is fixed to the base, link `a`. What is to move freely is a model of its own"}));
  EXPECT_EQ(
      problems_of(link("wheel") + "\n" + link("arm") + "\n" + joint("j", "fixed", "wheel", "wheels")),
      (Lines{
          "warning 5:" + std::to_string(1 + std::string("<joint name='j' type='fixed'><parent>wheel</parent>").size()) +
              " child of joint `j`: there is no `wheels` (did you mean `wheel`?); there are `arm`, `j`, `wheel`; the "
              "joint is left out",
          base + "arm`; it is fixed to the base, link `wheel`. What is to move freely is a model of its own"}));
  EXPECT_EQ(problems_of(link("a", "\n<pose relative_to='somewhere'>0 0 0 0 0 0</pose>")),
            Lines{"error 4:1 <pose relative_to> of link `a`: there is no `somewhere`; there are `a`"});
  EXPECT_EQ(robot_of("<sdf version='1.9'>\n<model name='m' canonical_link='somewhere'>" + link("a") + "</model></sdf>")
                .problems,
            Lines{"error 2:1 <model canonical_link>: there is no `somewhere`; there are `a`"});
  EXPECT_EQ(problems_of("<link name='a::b'>" + inertial() + "</link>"),
            Lines{"error 3:1 the link is named `a::b`; names have no `::` since SDFormat 1.8. Write a <model> within "
                  "the model"});
  EXPECT_EQ(problems_of(""), Lines{"error 2:1 model `m` has no link; it needs at least one <link name=\"...\"/>"});
}

TEST(SdfProblems, JointsThatCannotBe) {
  const auto of = [](const std::string& type, const std::string& inside) {
    return problems_of(link("a") + link("b") + "\n" + joint("j", type, "a", "b", inside));
  };
  EXPECT_EQ(of("axis_joint", ""),
            Lines{"warning 4:1 joint `j` is of the unknown type `axis_joint`, and types are `revolute`, `continuous`, "
                  "`prismatic`, `fixed`, `universal`, `revolute2`, `ball`, `screw` and 1 more; it is taken as fixed"});
  EXPECT_EQ(of("revolute", ""), Lines{"warning 4:1 joint `j` has no <axis>; the axis is z, SDFormat's default"});
  EXPECT_EQ(
      problems_of(link("a") + link("b") + "\n<joint name='j' type='revolute'><parent>a</parent><child>b</child>\n" +
                  axis("0 0 0") + "</joint>"),
      Lines{"warning 5:1 joint `j`: its <axis> has no direction, and <xyz> is a vector of length 1, such as 0 0 1; it "
            "is taken as fixed"});
  EXPECT_EQ(of("revolute", axis("0 0 1", "<limit><lower>2</lower><upper>1</upper></limit>")),
            Lines{"warning 4:1 joint `j`: its lower limit 2 is above the upper one 1; they are exchanged"});
  EXPECT_EQ(problems_of(link("a") + "\n<joint name='j' type='fixed'><parent>a</parent></joint>"),
            Lines{"warning 4:1 joint `j` is left out: it has no child; write <child>LINK</child>"});
}

TEST(SdfProblems, ChainsAreCutWhereTheyClose) {
  const Robot twice = robot_of(model(link("a") + link("b") + link("c") + joint("j", "fixed", "a", "c") +
                                     joint("l", "fixed", "a", "b") + "\n" + joint("k", "fixed", "b", "c")));
  EXPECT_EQ(twice.problems, Lines{"warning 4:1 joint `k` closes a chain and is left out: its child, link `c`, hangs on "
                                  "joint `j` already, and what moves has one parent"});
  EXPECT_EQ(twice.tree.links().size(), 3u);
  EXPECT_EQ(problems_of(link("a") + link("b") + joint("j", "fixed", "a", "b") + "\n" + joint("k", "fixed", "b", "a")),
            Lines{"warning 4:1 joint `k` closes a loop and is left out: link `a`, to which it leads, would be its own "
                  "descendant"});
  EXPECT_EQ(
      problems_of(link("a") + link("b") + joint("j", "fixed", "world", "b") + "\n" + joint("k", "fixed", "a", "b"))
          .back(),
      "warning 3:" + std::to_string(1 + link("a").size() + link("b").size()) +
          " joint `j` closes a chain and is left out: its child, link `b`, hangs on joint `k` already, and what moves "
          "has one parent");
}

TEST(SdfProblems, WhatNoJointLeadsToIsFixedToTheBase) {
  const Robot robot = robot_of(model(link("a", "<pose>1 0 0 0 0 0</pose>") + "\n" + link("b") + "\n" + link("c") +
                                     joint("j", "revolute", "b", "c", axis("0 0 1"))));
  EXPECT_EQ(robot.problems,
            Lines{"warning 4:1 no joint leads to link `b`; it is fixed to the base, link `a`. What is to "
                  "move freely is a model of its own"});
  EXPECT_EQ(robot.blocks(), (Lines{"base a", "translation", "body b", "revolute j", "body c"}));
  EXPECT_TRUE(near(robot.pose("c"), {{-1, 0, 0}, Quat::Identity()}));
  // a model that does not move needs no warning
  EXPECT_EQ(without_notes(problems_of("<static>true</static>" + link("a") + link("b"))), Lines{});
}

TEST(SdfProblems, AModelOfOldVersionsIsRead) {
  for (const char* version : {"1.2", "1.3"}) {
    const Robot robot = robot_of(
        model(link("a") + link("b", "<pose>0.5 0 0 0 0 0</pose>") + joint("j", "revolute", "a", "b", axis("0 1 0")),
              version));
    EXPECT_EQ(robot.problems, Lines{}) << version;
    EXPECT_EQ(robot.pose("b").position.x(), 0.5) << version;
  }
  EXPECT_EQ(robot_of("<gazebo version='1.2'><model name='m'>" + link("a") + "</model></gazebo>").problems, Lines{});
}

TEST(SdfProblems, AModelThatIsALightIsAFrame) {
  const Robot robot = robot_of("<sdf version='1.6'>\n<light name='sun' type='directional'/></sdf>");
  EXPECT_EQ(robot.problems,
            Lines{"warning 2:1 the file holds only the light `sun`, which is not simulated; the robot is "
                  "a frame without a body"});
  EXPECT_EQ(robot.blocks(), Lines{"base sun"});
}

TEST(SdfProblems, FramesThatStandOnEachOther) {
  const Lines lines =
      problems_of(link("a", "<pose relative_to='f'/>") + "<frame name='f'><pose relative_to='a'/></frame>");
  ASSERT_EQ(lines.size(), 1u) << testing::PrintToString(lines);
  EXPECT_NE(lines[0].find("libsdformat: PoseRelativeToGraph cycle detected"), std::string::npos) << lines[0];
}

TEST(SdfProblems, MassesThatNoBodyHas) {
  const auto of = [](const std::string& mass, const std::string& ixx) {
    return problems_of(
        "<link name='a'><collision "
        "name='c'><geometry><sphere><radius>1</radius></sphere></geometry></collision>\n<inertial><mass>" +
        mass + "</mass><inertia><ixx>" + ixx +
        "</ixx><ixy>0</ixy><ixz>0</ixz><iyy>1</iyy><iyz>0</iyz><izz>1</izz></inertia></inertial></link>");
  };
  EXPECT_EQ(of("-1", "1"),
            (Lines{"warning 4:1 link `a`: the mass is -1 kg and taken as 0, a frame without a body; it is 0 or more",
                   "warning 3:1 no link has a mass; only motion without forces can move the robot"}));
  EXPECT_EQ(of("5", "0"),
            Lines{"warning 4:1 link `a`: its principal moments of inertia are 0 1 1 kg m^2, and the least "
                  "must be above 1e-9 times the greatest; those of its shapes with uniform density "
                  "and 5 kg are used: 2 2 2"});
  EXPECT_EQ(of("5", "3"), Lines{"warning 4:1 link `a`: its principal moments of inertia are 1 1 3 kg m^2, which no "
                                "body has: none exceeds the sum of "
                                "the other two. They are used as they are"});
  EXPECT_EQ(of("0", "1"), (Lines{"note 4:1 link `a` has the mass 0: it is a frame without a body",
                                 "warning 3:1 no link has a mass; only motion without forces can move the robot"}));
}

TEST(SdfProblems, IncludesThatCannotBe) {
  const ScratchFolder folder;
  folder.file("self.sdf", "<sdf version='1.9'><model name='s'><include><uri>self.sdf</uri></include></model></sdf>");
  folder.file("broken.sdf", "<sdf version='1.9'><model name='s'>");
  folder.file("robot.urdf", "<robot name='r'/>");
  folder.file("light.sdf", "<sdf version='1.9'><light name='l' type='point'/></sdf>");
  folder.file("mistake.sdf",
              "<sdf version='1.9'><model name='s'>\n<link name='l'><pose>1 2</pose></link></model></sdf>");
  const auto of = [&](const std::string& uri) {
    return robot_of(model(link("a") + "\n<include><uri>" + uri + "</uri></include>"), folder.path("")).problems;
  };
  const auto file = [&](const std::string& name) { return folder.path(name); };
  EXPECT_EQ(of("self.sdf"),
            (Lines{"warning 0:0 in self.sdf:1:36: <include> of `self.sdf` is left out: " + file("self.sdf") +
                       ": it includes itself",
                   "warning 0:0 in self.sdf:1:20: model `s` has no link; it needs at least one <link name=\"...\"/>",
                   "warning 4:1 <include> of `self.sdf` is left out: " + file("self.sdf") +
                       ": it has mistakes, as reported before"}));
  EXPECT_EQ(of("broken.sdf"),
            Lines{"warning 4:1 <include> of `broken.sdf` is left out: " + file("broken.sdf") +
                  ": the file is not well-formed XML: a closing tag does not match the element that is open"});
  EXPECT_NE(of("robot.urdf").at(0).find("it is URDF"), std::string::npos);
  EXPECT_EQ(of("light.sdf"), Lines{"warning 4:1 <include> of `light.sdf` is left out: " + file("light.sdf") +
                                   ": it holds no <model>, but a `light`"});
  EXPECT_EQ(of("mistake.sdf"),
            (Lines{"warning 0:0 in mistake.sdf:2:16: <pose>: `1 2` has 2 numbers, and needs 6 separated by blanks",
                   "warning 4:1 <include> of `mistake.sdf` is left out: " + file("mistake.sdf") +
                       ": it has mistakes, as reported before"}));
  EXPECT_EQ(of(""),
            Lines{"warning 4:1 <include> of `` is left out: it has no <uri>; write <uri>FOLDER/model.sdf</uri>"});
}

TEST(SdfProblems, IncludesThatMultiplyAreStopped) {
  const ScratchFolder folder;
  folder.file("f0.sdf", "<sdf version='1.9'><model name='m'>" + link("a") + "</model></sdf>");
  for (int i = 1; i <= 6; ++i) {
    std::string inside;
    for (int k = 0; k < 10; ++k)
      inside += concat("<include><uri>f", i - 1, ".sdf</uri><name>n", k, "</name></include>");
    folder.file(concat("f", i, ".sdf"), "<sdf version='1.9'><model name='m'>" + inside + "</model></sdf>");
  }
  const Robot robot = robot_of(model("<include><uri>f6.sdf</uri></include>"), folder.path(""));
  ASSERT_FALSE(robot.problems.empty());
  EXPECT_NE(robot.problems[0].find("with all its includes the file has more than 200000 elements"), std::string::npos)
      << robot.problems[0];
}

TEST(SdfProblems, WhatIsWrongInAnIncludedFileIsToldWithItsNameAndPlace) {
  const test::ScratchFolder folder;
  folder.file("arm.sdf", "<sdf version='1.9'><model name='arm'>\n" + link("upper") + link("lower") + "\n" +
                             joint("elbow", "revolute", "upper", "lower", axis("0 1 0")) + "\n" +
                             joint("second", "revolute", "upper", "lower", axis("0 1 0")) + "</model></sdf>");
  const Robot robot = robot_of(model("<include><uri>arm.sdf</uri></include>"), folder.path(""));
  ASSERT_EQ(robot.problems.size(), 1u);
  EXPECT_TRUE(robot.problems[0].starts_with("warning 0:0 in arm.sdf:4:1: joint `arm.second` closes a chain"))
      << robot.problems[0];
}

TEST(SdfProblems, MistakesOfAFileAreToldAllAtOnce) {
  EXPECT_EQ(problems_of(link("a", "<pose>x</pose>") + "\n" + link("a", "<wings>0</wings>") + "\n" +
                        joint("j", "axis_joint", "a", "c"))
                .size(),
            5u);
}

}  // namespace
}  // namespace muro::sdf
