// SPDX-License-Identifier: MIT
// Reads files through the plugin and the parser process.
#include "core/simulation.hpp"
#include "plugins/common/parser_process/builder_calls/record.hpp"
#include "plugins/common/parser_process/builder_calls/replay.hpp"
#include "reading_testing.hpp"
#include "tests/support/scene.hpp"

namespace muro::mjcf {
namespace {

using parser_process::Reader;
using parser_process::Writer;

/// Everything that a record can hold.
const std::string everything = R"(<mujoco><worldbody><body name="a"><freejoint/><geom size="0.1"/>
<body name="b"><joint name="j" axis="0 1 0" ref="0.5" range="-1 1" limited="true" stiffness="1"/><geom type="box" size="1 1 1"/></body>
<body name="c"><joint name="k" type="slide"/><geom size="0.1"/></body></body></worldbody>
<actuator><position joint="j" kp="2"/></actuator></mujoco>)";

TEST(MjcfProcess, WhatIsRecordedOfAModelIsMadeOfIt) {
  RobotTree direct, replayed;
  read_text(everything, "/nowhere/a.xml", direct);
  Writer calls;
  builder_calls::RobotRecorder recorder(calls);
  read_text(everything, "/nowhere/a.xml", recorder);
  builder_calls::replay(Reader(calls.bytes()), replayed);
  ASSERT_EQ(direct.nodes().size(), replayed.nodes().size());
  ASSERT_EQ(direct.components().size(), replayed.components().size());
  std::size_t constants = 0;
  for (std::size_t i = 0; i < direct.components().size(); ++i) {
    const auto &x = direct.components()[i], &y = replayed.components()[i];
    EXPECT_EQ(x.name, y.name);
    ASSERT_EQ(x.constants.size(), y.constants.size()) << x.name;
    for (std::size_t k = 0; k < x.constants.size(); ++k, ++constants) {
      EXPECT_EQ(x.constants[k].key.name, y.constants[k].key.name) << x.name;
      EXPECT_TRUE(x.constants[k].data == y.constants[k].data) << x.name << ": " << x.constants[k].key.name;
    }
  }
  EXPECT_GT(constants, 15u);
  EXPECT_EQ(direct.texts(), replayed.texts());
  EXPECT_EQ(lines_of(direct.problems()), lines_of(replayed.problems()));
}

TEST(MjcfProcess, GarbledRecordsAreErrors) {
  Writer calls;
  builder_calls::RobotRecorder recorder(calls);
  read_text(everything, "/nowhere/a.xml", recorder);
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

/// Returns the message about a model that the plugin reads from a file.
std::string message_of(const std::string& path) {
  Simulation simulation(test::plugins());
  try {
    simulation.read_model(path);
  } catch (const std::exception& e) {
    return e.what();
  }
  return "";
}

TEST(MjcfProcess, FilesThatEndTheParserEndNothingElse) {
  const test::ScratchFolder folder;
  // buffers of 16 GB, and a file that does not end
  EXPECT_NE(
      message_of(folder.file("huge.xml", "<mujoco><size nstack='2000000000' njmax='2000000'/><worldbody/></mujoco>")),
      "");
  std::filesystem::create_symlink("/dev/zero", folder.path("endless.stl"));
  const std::string endless = message_of(
      folder.file("endless.xml", "<mujoco><asset><mesh name='m' file='endless.stl'/></asset><worldbody/></mujoco>"));
  EXPECT_NE(endless.find("endless.xml"), std::string::npos) << endless;
  EXPECT_EQ(message_of(folder.file("fine.xml", everything)), "");
}

TEST(MjcfProcess, TheMessageHasFileAndLine) {
  const test::ScratchFolder folder;
  const std::string path = folder.file("bad.mjcf", mujoco("<bdy/>"));
  EXPECT_NE(message_of(path).find(path + ":3:0: MuJoCo 2."), std::string::npos) << message_of(path);
}

}  // namespace
}  // namespace muro::mjcf
