// SPDX-License-Identifier: MIT
// Worlds: gravity, scenery, models.
#include <gtest/gtest.h>

#include <numbers>

#include "muro/toolkit/rotations.hpp"
#include "reading_testing.hpp"

namespace muro::sdf {
namespace {

using std::numbers::pi;
using test::ScratchFolder;

struct ReadWorld {
  WorldModel model;
  Lines problems;
};

/// Returns a file with a world in line 2; `inside` begins at line 3.
ReadWorld world_of(const std::string& inside, const std::string& version = "1.9",
                   const std::string& folder = "/nowhere") {
  ReadWorld out;
  read_world_text("<sdf version='" + version + "'>\n<world name='w'>\n" + inside + "\n</world></sdf>", folder,
                  out.model);
  out.model.close();
  out.problems = lines_of(out.model.problems());
  return out;
}
const WorldModel::Scenery* scenery(const ReadWorld& world, const std::string& name) {
  for (const auto& s : world.model.scenery())
    if (s.name == name) return &s;
  return nullptr;
}
std::string box(const std::string& kind, const std::string& size) {
  return "<" + kind + " name='x'><geometry><box><size>" + size + "</size></box></geometry></" + kind + ">";
}

TEST(SdfWorld, StaticModelsAreSceneryOneObjectALink) {
  const ReadWorld world = world_of(
      "<model name='ground'><static>true</static><link name='l'><collision name='c'><geometry><plane><normal>0 0 "
      "1</normal><size>9 9</size>"
      "</plane></geometry></collision></link></model>"
      "<model name='the house'><static>1</static><pose>1 2 0 0 0 1.5707963267948966</pose><link name='wall'><pose>1 0 "
      "0.5 0 0 0</pose>" +
      box("collision", "1 2 3") + box("visual", "1 1 1") + "</link><link name='roof'><pose>0 0 2 0 0 0</pose>" +
      box("visual", "2 2 1") + "</link><link name='empty'/></model>");
  EXPECT_EQ(world.problems, Lines{});
  ASSERT_EQ(world.model.scenery().size(), 3u);
  EXPECT_EQ(scenery(world, "ground")->collisions.at(0).kind, ShapeKind::plane);
  const auto* wall = scenery(world, "the_house.wall");
  ASSERT_NE(wall, nullptr);
  EXPECT_TRUE(near(wall->pose, {{1, 3, 0.5}, from_rpy(0, 0, pi / 2)}));
  EXPECT_EQ(wall->collisions.at(0).size, Vec3(1, 2, 3));
  EXPECT_EQ(wall->visuals.at(0).size, Vec3(1, 1, 1));
  EXPECT_EQ(scenery(world, "the_house.roof")->collisions.size(), 0u);
  EXPECT_FALSE(world.model.gravity().has_value());
}

TEST(SdfWorld, GravityIsThatOfTheFileInAllVersions) {
  EXPECT_EQ(world_of("<gravity>0 0 -1.6</gravity>").model.gravity(), Vec3(0, 0, -1.6));
  for (const char* version : {"1.4", "1.5"}) {
    const ReadWorld world = world_of("<physics type='ode'><gravity>0 0 -1.6</gravity></physics>", version);
    EXPECT_EQ(world.model.gravity(), Vec3(0, 0, -1.6)) << version;
    EXPECT_EQ(world.problems.size(), 1u);  // warning about <physics>
  }
}

TEST(SdfWorld, OtherModelsCanMoveAndTheirBaseStandsWhereTheFileSays) {
  const ReadWorld world = world_of(
      "<frame name='gate'><pose>0 5 0 0 0 0</pose></frame>\n<model name='cart'><pose relative_to='gate'>1 0 0 0 0 "
      "1.5707963267948966</pose>" +
      link("body", "<pose>0 0 0.5 0 0 0</pose>") + link("wheel") +
      joint("j", "revolute", "body", "wheel", axis("0 1 0")) + "</model>");
  EXPECT_EQ(world.problems, Lines{});
  ASSERT_EQ(world.model.models().size(), 1u);
  const auto& cart = world.model.models()[0];
  EXPECT_EQ(cart.name, "cart");
  EXPECT_TRUE(near(cart.pose, {{1, 5, 0.5}, from_rpy(0, 0, pi / 2)}));
  EXPECT_TRUE(cart.tree.usable());
  EXPECT_EQ(cart.tree.links().size(), 2u);
}

TEST(SdfWorld, IncludedModelsMayBeRobotsOrScenery) {
  const ScratchFolder folder;
  folder.file("tree/model.sdf", "<sdf version='1.6'><model name='tree'><static>true</static><link name='l'>" +
                                    box("collision", "1 1 9") + "</link></model></sdf>");
  const ReadWorld world = world_of(
      "<include><uri>tree</uri><pose>1 0 0 0 0 0</pose></include>"
      "<include><uri>tree/model.sdf</uri><name>oak</name><pose>2 0 0 0 0 0</pose></include>"
      "<include><uri>tree</uri><name>log</name><static>false</static></include>",
      "1.9", folder.path(""));
  EXPECT_EQ(world.problems, Lines{});
  EXPECT_TRUE(near(scenery(world, "tree")->pose, {{1, 0, 0}, Quat::Identity()}));
  EXPECT_TRUE(near(scenery(world, "oak")->pose, {{2, 0, 0}, Quat::Identity()}));
  ASSERT_EQ(world.model.models().size(), 1u);
  EXPECT_EQ(world.model.models()[0].name, "log");
}

TEST(SdfWorld, TheModelsOfGazeboThatMostWorldsAskForNeedNoGazebo) {
  const ReadWorld world =
      world_of("<include><uri>model://sun</uri></include>\n<include><uri>model://ground_plane</uri></include>");
  EXPECT_EQ(world.problems,
            (Lines{"note 3:1 <include> of `model://sun` is left out: there are no lights",
                   "note 4:1 `model://ground_plane` is not found; a plane of friction 1 stands for it"}));
  ASSERT_EQ(world.model.scenery().size(), 1u);
  EXPECT_EQ(world.model.scenery()[0].collisions.at(0).kind, ShapeKind::plane);
}

TEST(SdfWorld, WhatIsNotFoundIsLeftOutAndNothingIsFetched) {
  const ReadWorld world = world_of(
      "<include><uri>model://nowhere_house</uri></include>\n<include><uri>https://fuel.gazebosim.org/x</uri></"
      "include>");
  ASSERT_EQ(world.problems.size(), 2u);
  EXPECT_TRUE(world.problems[0].starts_with(
      "warning 3:1 <include> of `model://nowhere_house` is left out: there is no such file or folder; looked for "));
  EXPECT_EQ(
      world.problems[1],
      "warning 4:1 <include> of `https://fuel.gazebosim.org/x` is left out: nothing is fetched from the network; save "
      "the model beside this file and give its path");
}

TEST(SdfWorld, AModelThatIsNoTreeIsMadeOneAndSaysSoItself) {
  const ReadWorld world = world_of("<model name='pile'>" + link("a", box("collision", "1 1 1")) + "\n" +
                                   link("b", "<pose>0 0 1 0 0 0</pose>" + box("collision", "1 1 1")) + "</model>");
  EXPECT_EQ(world.problems, Lines{});
  const RobotTree& tree = world.model.models().at(0).tree;
  EXPECT_EQ(lines_of(tree.problems()),
            Lines{"warning 4:1 no joint leads to link `b`; it is fixed to the base, link `a`. "
                  "What is to move freely is a model of its own"});
  ASSERT_EQ(tree.links().size(), 2u);
  EXPECT_EQ(tree.links()[1].link.origin.position, Vec3(0, 0, 1));
}

TEST(SdfWorld, ABadModelIsLeftOutAndTheOthersAreThere) {
  const std::string good = "<model name='good'>" + link("a") + "</model>\n";
  const std::string house =
      "<model name='house'><static>true</static><link name='l'>" + box("collision", "1 1 1") + "</link></model>\n";
  const auto expect_rest = [](const ReadWorld& world) {
    ASSERT_EQ(world.model.models().size(), 1u);
    EXPECT_EQ(world.model.models()[0].name, "good");
    EXPECT_TRUE(world.model.models()[0].tree.usable());
    EXPECT_NE(scenery(world, "house"), nullptr);
  };
  const ReadWorld number = world_of(good + "<model name='bad'><pose>here</pose>" + link("a") + "</model>\n" + house);
  EXPECT_EQ(number.problems,
            Lines{"warning 4:19 model `bad` is left out: <pose>: `here` is no number; write it like 0.05 or 5e-2"});
  expect_rest(number);
  // a mistake that only libsdformat finds
  const ReadWorld frames = world_of(good + "<model name='bad'>" + link("a", "<pose relative_to='f'/>") +
                                    "<frame name='f'><pose relative_to='a'/></frame></model>\n" + house);
  ASSERT_EQ(frames.problems.size(), 1u);
  EXPECT_TRUE(frames.problems[0].starts_with(
      "warning 4:1 model `bad` is left out: libsdformat: PoseRelativeToGraph cycle detected"))
      << frames.problems[0];
  expect_rest(frames);
}

TEST(SdfWorld, RobotsAndWorldsAreToldApart) {
  WorldModel world;
  read_world_text(model(link("a")), "/nowhere", world);
  EXPECT_EQ(lines_of(world.problems()),
            Lines{"error 1:1 the file holds no <world>; it describes a robot: name it as the `model` of a robot"});
  EXPECT_EQ(robot_of("<sdf version='1.9'><world name='w'/></sdf>").problems,
            Lines{"error 1:1 the file holds no <model>; it describes a world: name it under `world: {file: ...}`"});
}

}  // namespace
}  // namespace muro::sdf
