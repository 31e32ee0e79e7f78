// SPDX-License-Identifier: MIT
// Every mistake is reported in full, with its location, and all mistakes of a file at once.
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
  for (const char* version : {"1.3", "1.0", "", "x", "2.0", "-1.9", "1e9.5"})
    EXPECT_EQ(robot_of(model(link("a"), version)).problems,
              Lines{"error 1:1 the file is of SDFormat `" + std::string(version) +
                    "`; versions 1.4 to 1.9 are read. `gz sdf -p FILE` of Gazebo converts older ones"});
  EXPECT_EQ(robot_of("<sdf version='1.9'/>").problems, Lines{"error 1:1 the file holds no <model>"});
}

TEST(SdfProblems, NumbersThatAreNone) {
  const auto of = [](const std::string& size) {
    return problems_of(
        link("a", "<collision name='c'>\n<geometry><box><size>" + size + "</size></box></geometry></collision>"));
  };
  EXPECT_EQ(
      of("1,5 1 1"),
      Lines{"error 4:16 <size>: `1,5 1 1` is no number; the decimal sign is a point, and blanks separate numbers"});
  EXPECT_EQ(of("1 1"), Lines{"error 4:16 <size>: `1 1` has 2 numbers, and needs 3 separated by blanks"});
  EXPECT_EQ(of("1 1 nan"), Lines{"error 4:16 <size>: `1 1 nan` is not finite"});
  EXPECT_EQ(of("1 1 big"), Lines{"error 4:16 <size>: `1 1 big` is no number; write it like 0.05 or 5e-2"});
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
  EXPECT_EQ(
      problems_of("<link/>" + link("a") + "\n<joint type='fixed'><parent>a</parent><child>a</child></joint>"),
      (Lines{"error 4:1 joint `` joins link `a` with itself", "error 3:1 a link has no name; write <link name=\"...\">",
             "error 4:1 a joint has no name; write <joint name=\"...\">"}));
  EXPECT_EQ(problems_of(link("a") + "\n" + link("a")),
            Lines{"error 4:1 a link has the name `a` of the link in line 3; names are unique within a model"});
  EXPECT_EQ(
      problems_of(link("wheel") + link("arm") + "\n" + joint("j", "fixed", "wheel", "wheels")),
      Lines{"error 4:" + std::to_string(1 + std::string("<joint name='j' type='fixed'><parent>wheel</parent>").size()) +
            " child of joint `j`: there is no `wheels` (did you mean `wheel`?); there are `arm`, `j`, `wheel`"});
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
            Lines{"error 4:1 joint `j` is of the unknown type `axis_joint`; types are `revolute`, "
                  "`continuous`, `prismatic`, `fixed`, "
                  "`universal`, `revolute2`, `ball`, `screw` and 1 more"});
  EXPECT_EQ(of("revolute", ""), Lines{"warning 4:1 joint `j` has no <axis>; the axis is z, SDFormat's default"});
  EXPECT_EQ(
      problems_of(link("a") + link("b") + "\n<joint name='j' type='revolute'><parent>a</parent><child>b</child>\n" +
                  axis("0 0 0") + "</joint>"),
      Lines{"error 5:1 joint `j`: its <axis> has no direction; <xyz> is a vector of length 1, such as 0 0 1"});
  EXPECT_EQ(of("revolute", axis("0 0 1", "<limit><lower>2</lower><upper>1</upper></limit>")),
            Lines{"warning 4:1 joint `j`: its lower limit 2 is above the upper one 1; they are exchanged"});
  EXPECT_EQ(problems_of(link("a") + "\n<joint name='j' type='fixed'><parent>a</parent></joint>"),
            Lines{"error 4:1 joint `j` has no child; write <child>LINK</child>"});
}

TEST(SdfProblems, WhatIsNoTree) {
  EXPECT_EQ(problems_of(link("a") + link("b") + link("c") + joint("j", "fixed", "a", "c") +
                        joint("l", "fixed", "a", "b") + "\n" + joint("k", "fixed", "b", "c")),
            Lines{"error 4:1 link `c` is the child of two joints, `j` and `k`; robots are trees, and closed chains are "
                  "not simulated. Leave one out"});
  EXPECT_EQ(
      problems_of(link("a") + link("b") + joint("j", "fixed", "a", "b") + "\n" + joint("k", "fixed", "b", "a")),
      Lines{"error 4:1 joint `k` closes a loop of joints: link `a` is its own descendant; robots are trees, and closed "
            "chains are not simulated"});
  EXPECT_EQ(problems_of(link("a") + "\n" + link("b") + "\n" + link("c") + joint("j", "fixed", "b", "c")),
            Lines{"error 4:1 no joint leads to 2 links: `a`, `b`; exactly one is the base. Join the others to it, with "
                  "fixed joints if they do not "
                  "move, or make them models of their own"});
  EXPECT_EQ(
      problems_of(link("a") + link("b") + joint("j", "fixed", "world", "b") + "\n" + joint("k", "fixed", "a", "b"))
          .back(),
      "error 3:" + std::to_string(1 + link("a").size() + link("b").size()) +
          " link `b` is the child of two joints, `k` and `j`; robots are trees, and closed chains are not simulated. "
          "Leave one out");
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
  EXPECT_EQ(of("-1", "1"), Lines{"error 4:1 link `a`: the mass is -1 kg; it is 0 (a frame without a body) or more"});
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
            (Lines{"error 0:0 in self.sdf:1:36: <include> of `self.sdf` is left out: " + file("self.sdf") +
                       ": it includes itself",
                   "error 0:0 in self.sdf:1:20: model `s` has no link; it needs at least one <link name=\"...\"/>"}));
  EXPECT_EQ(of("broken.sdf"),
            Lines{"error 4:1 <include> of `broken.sdf` is left out: " + file("broken.sdf") +
                  ": the file is not well-formed XML: a closing tag does not match the element that is open"});
  EXPECT_NE(of("robot.urdf").at(0).find("it is URDF"), std::string::npos);
  EXPECT_EQ(of("light.sdf"), Lines{"error 4:1 <include> of `light.sdf` is left out: " + file("light.sdf") +
                                   ": it holds no <model>, but a `light`"});
  EXPECT_EQ(of("mistake.sdf"),
            Lines{"error 0:0 in mistake.sdf:2:16: <pose>: `1 2` has 2 numbers, and needs 6 separated by blanks"});
  EXPECT_EQ(of(""), Lines{"error 4:1 <include> of `` is left out: it has no <uri>; write <uri>FOLDER/model.sdf</uri>"});
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

TEST(SdfProblems, MistakesOfAFileAreToldAllAtOnce) {
  EXPECT_EQ(problems_of(link("a", "<pose>x</pose>") + "\n" + link("a", "<gravity>0</gravity>") + "\n" +
                        joint("j", "axis_joint", "a", "c"))
                .size(),
            5u);
}

}  // namespace
}  // namespace muro::sdf
