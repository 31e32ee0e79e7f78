// SPDX-License-Identifier: MIT
// Models through the parser process: the recorded and replayed calls equal the calls of the reader.
#include "plugins/common/parser_process/builder_calls/record.hpp"
#include "plugins/common/parser_process/builder_calls/replay.hpp"
#include "reading_testing.hpp"

namespace muro::sdf {
namespace {

using parser_process::Reader;
using parser_process::Writer;

void expect_same(const RobotTree& a, const RobotTree& b) {
  ASSERT_EQ(a.nodes().size(), b.nodes().size());
  for (std::size_t i = 0; i < a.nodes().size(); ++i) {
    EXPECT_EQ(a.nodes()[i].kind, b.nodes()[i].kind) << i;
    EXPECT_EQ(a.nodes()[i].name, b.nodes()[i].name) << i;
    EXPECT_EQ(a.nodes()[i].parent, b.nodes()[i].parent) << i;
  }
  ASSERT_EQ(a.components().size(), b.components().size());
  for (std::size_t i = 0; i < a.components().size(); ++i) {
    const auto &x = a.components()[i], &y = b.components()[i];
    EXPECT_EQ(x.name, y.name);
    ASSERT_EQ(x.constants.size(), y.constants.size()) << x.name;
    for (std::size_t k = 0; k < x.constants.size(); ++k) {
      EXPECT_EQ(x.constants[k].key.name, y.constants[k].key.name) << x.name;
      EXPECT_EQ(x.constants[k].count, y.constants[k].count) << x.name;
      EXPECT_TRUE(x.constants[k].data == y.constants[k].data) << x.name << ": " << x.constants[k].key.name;
    }
  }
  EXPECT_EQ(a.texts(), b.texts());
  EXPECT_EQ(lines_of(a.problems()), lines_of(b.problems()));
}

/// Everything that a model can have: meshes, pictures, limits, followers, problems.
const std::string everything =
    model(link("a",
               "<visual name='v'><geometry><mesh><uri>wheel.stl</uri></mesh></geometry></visual>"
               "<collision name='c'><geometry><sphere><radius>0.1</radius></sphere></geometry></collision>"
               "<gravity>false</gravity>") +
          link("b") + link("c", "<pose>0 0 1 0.1 0.2 0.3</pose>") + link("d") +
          joint("j", "revolute", "a", "b", axis("0 0 1", "<limit><lower>-1</lower><upper>2</upper></limit>")) +
          joint("k", "prismatic", "a", "c", axis("1 0 0", "<mimic joint='j'><multiplier>2</multiplier></mimic>")) +
          joint("l", "ball", "c", "d"));

TEST(SdfProcess, WhatIsRecordedOfAModelIsMadeOfIt) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("everything.sdf", everything);
  folder.file("wheel.stl", "solid\nendsolid\n");
  RobotTree direct, replayed;
  read_file(path, direct);
  Writer calls;
  builder_calls::RobotRecorder recorder(calls);
  read_file(path, recorder);
  builder_calls::replay(Reader(calls.bytes()), replayed);
  EXPECT_GT(direct.nodes().size(), 8u);
  EXPECT_GT(direct.texts().size(), 1u);
  EXPECT_FALSE(direct.problems().empty());
  expect_same(direct, replayed);
}

TEST(SdfProcess, WhatIsRecordedOfAWorldIsMadeOfIt) {
  const test::ScratchFolder folder;
  std::string robot = everything;
  robot.erase(0, robot.find("<model"));
  robot.erase(robot.find("</sdf>"));
  folder.file("wheel.stl", "solid\nendsolid\n");
  const std::string path = folder.file(
      "yard.world",
      "<sdf version='1.9'><world name='w'><gravity>0 0 -3.7</gravity>" + robot +
          "<model name='wall'><static>true</static><link name='l'><visual name='v'><geometry><mesh><uri>wheel.stl</uri>"
          "</mesh></geometry></visual></link></model><wind/></world></sdf>");
  WorldModel direct, replayed;
  read_world_file(path, direct);
  Writer calls;
  builder_calls::WorldRecorder recorder(calls);
  read_world_file(path, recorder);
  builder_calls::replay(Reader(calls.bytes()), replayed);
  EXPECT_EQ(direct.gravity(), replayed.gravity());
  ASSERT_EQ(direct.scenery().size(), 1u);
  ASSERT_EQ(replayed.scenery().size(), 1u);
  EXPECT_EQ(direct.scenery()[0].name, replayed.scenery()[0].name);
  EXPECT_EQ(direct.scenery()[0].visuals[0].mesh, replayed.scenery()[0].visuals[0].mesh);
  EXPECT_EQ(direct.texts(), replayed.texts());
  EXPECT_EQ(lines_of(direct.problems()), lines_of(replayed.problems()));
  ASSERT_EQ(direct.models().size(), 1u);
  ASSERT_EQ(replayed.models().size(), 1u);
  EXPECT_EQ(direct.models()[0].pose.position, replayed.models()[0].pose.position);
  expect_same(direct.models()[0].tree, replayed.models()[0].tree);
}

TEST(SdfProcess, GarbledRecordsAreErrors) {
  const test::ScratchFolder folder;
  Writer calls;
  builder_calls::RobotRecorder recorder(calls);
  read_file(folder.file("everything.sdf", everything), recorder);
  const std::span<const std::byte> whole = calls.bytes();
  int errors = 0;
  for (std::size_t i = 0; i < whole.size(); ++i) {
    std::vector<std::byte> bytes(whole.begin(), whole.end());
    bytes[i] ^= std::byte{0xff};
    for (const auto& garbled : {std::span<const std::byte>(bytes), whole.first(i)}) {
      RobotTree tree;
      try {
        builder_calls::replay(Reader(garbled), tree);
      } catch (const Error&) {
        ++errors;
      }
    }
  }
  EXPECT_GT(errors, int(whole.size()) / 2);
}

}  // namespace
}  // namespace muro::sdf
