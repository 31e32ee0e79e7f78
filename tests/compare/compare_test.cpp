// SPDX-License-Identifier: MIT
// `muro compare` as a user runs it.
#include <gtest/gtest.h>

#include <regex>
#include <sstream>

#include "tests/support/files.hpp"

namespace muro::host {
namespace {

const std::string muro_program =
    std::string("cd " MURO_TEST_SOURCE_DIR " && MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " ") + MURO_PROGRAM;
const std::string urban = " compare examples/urban/urban.yaml --duration 2 --set robots.rovers.count=4 ";

/// Returns the columns of a CSV line after the label. The label has no comma here.
std::vector<std::string> columns(const std::string& line) {
  std::vector<std::string> all;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) all.push_back(cell);
  return all;
}

std::vector<std::vector<std::string>> compare(const std::string& arguments) {
  const test::ScratchFolder folder;
  const std::string file = folder.path("t.csv");
  const auto result = test::run_command(muro_program + urban + arguments + " --csv " + file);
  EXPECT_EQ(result.exit_code, 0) << result.output;
  std::vector<std::vector<std::string>> rows;
  std::istringstream in(test::text_of(file));
  for (std::string line; std::getline(in, line);) rows.push_back(columns(line));
  return rows;
}

TEST(Compare, DeviatesFromTheReferenceTheSameOnEveryRun) {
  const auto first = compare("--vary rovers.motion=point,differential_drive,simplified");
  const auto second = compare("--vary rovers.motion=point,differential_drive,simplified");
  ASSERT_EQ(first.size(), 4u);
  ASSERT_EQ(second.size(), 4u);
  for (std::size_t row = 1; row < 4; ++row) {
    EXPECT_GT(std::stod(first[row][3]), 0) << "the motion costs something";
    EXPECT_GE(std::stod(first[row][2]), std::stod(first[row][3])) << "and the whole no less";
    EXPECT_GT(std::stod(first[row][5]), 0) << "robots in real time";
    for (std::size_t c = 6; c < 13; ++c)
      EXPECT_EQ(first[row].size() > c ? first[row][c] : "", second[row].size() > c ? second[row][c] : "")
          << first[0][c] << " of " << first[row][0];
  }
  EXPECT_EQ(first[3][6], "0") << "the reference is the last";
  EXPECT_GT(std::stod(first[1][6]), 0);
  EXPECT_LT(std::stod(first[1][6]), 1) << "m after two seconds at 0.8 m/s";
}

TEST(Compare, AnotherReferenceTurnsTheDeviationRound) {
  const auto rows = compare("--vary rovers.motion=point,simplified");
  const auto turned = compare("--vary rovers.motion=point,simplified --reference point");
  ASSERT_EQ(rows.size(), 3u);
  ASSERT_EQ(turned.size(), 3u);
  EXPECT_EQ(rows[1][6], turned[2][6]);
  EXPECT_EQ(turned[1][6], "0");
}

TEST(Compare, ALevelThatIsNotThereIsAnErrorBeforeAnythingRuns) {
  const auto result = test::run_command(muro_program + urban + "--vary rovers.motion=point,bulet");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.output.rfind("--vary rovers.motion=point,bulet: no plugin offers `motion.bulet`", 0), 0u)
      << result.output;
  EXPECT_NE(result.output.find("; there are: motion."), std::string::npos) << result.output;
}

TEST(Compare, ALevelThatCannotServeTheRobotsIsTold) {
  const auto result =
      test::run_command(muro_program + urban + "--vary rovers.motion=omni,point --set robots.rovers.drive=off");
  EXPECT_EQ(result.exit_code, 1) << "nothing is left to compare\n" << result.output;
  EXPECT_NE(result.output.find("omni did not run:\n"), std::string::npos) << result.output;
  EXPECT_NE(result.output.find("\npoint *"), std::string::npos) << result.output;
}

TEST(Compare, OtherMistakesAreToldTogetherWithWhatIsAllowed) {
  const std::string vary = "--vary rovers.motion=point,simplified ";
  EXPECT_EQ(test::run_command(muro_program + urban + vary + "--reference simplifed").output,
            "--reference simplifed: nothing of this name is compared (did you mean `simplified`?); there are: point, "
            "simplified\n");
  const auto png = test::run_command(muro_program + urban + vary + "--out /tmp/a.png");
  EXPECT_EQ(png.exit_code, 2);
  EXPECT_EQ(
      png.output,
      "--out /tmp/a.png: pictures are SVG files, so name it *.svg; `rsvg-convert FILE.svg -o /tmp/a.png` (Debian: "
      "librsvg2-bin) makes it a PNG\n");
  EXPECT_EQ(test::run_command(muro_program + " compare examples/urban/urban.yaml").exit_code, 2) << "no --vary";
  EXPECT_EQ(test::run_command(muro_program + " compare examples/urban/urban.yaml --duration 0 " + vary).exit_code, 2);
}

TEST(Compare, SaysANoteOnce) {
  const test::ScratchFolder folder;
  folder.file("thin.urdf",
              "<robot name=\"thin\"><link name=\"body\"><inertial><mass value=\"1\"/><inertia ixx=\"1e-6\" ixy=\"0\" "
              "ixz=\"0\" iyy=\"1e-6\" iyz=\"0\" izz=\"1e-6\"/></inertial><collision><geometry><box size=\"1 1 1\"/>"
              "</geometry></collision></link></robot>");
  const std::string scenario =
      folder.file("s.yaml",
                  "duration: 0.05\nworld: {objects: {ground: {shape: plane}}}\nrobots:\n"
                  "  tool: &tool {model: thin.urdf, at: {z: 1}, motion: {use: motion.simplified}}\n"
                  "  other: {<<: *tool, at: {x: 3, z: 1}}\n");
  const auto result = test::run_command(muro_program + " compare " + scenario + " --vary tool.motion=simplified,point");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  const std::string note = "the inertia of `other` is less than a hundredth";
  const std::size_t first = result.output.find(note);
  EXPECT_NE(first, std::string::npos) << result.output;
  EXPECT_EQ(result.output.find(note, first + 1), std::string::npos) << result.output;
}

TEST(Compare, ShowsJointsAndLinksWhereRobotsHaveThem) {
  const test::ScratchFolder folder;
  const auto run = [&](const std::string& robot) {
    const std::string scenario = folder.file("s.yaml", "duration: 0.5\nrobots: {r: {" + robot +
                                                           ", motion: {use: motion.simplified, rate: 1000, "
                                                           "motion.simplified: {base: fixed}}}}\n");
    const auto result = test::run_command(muro_program + " compare " + scenario +
                                          " --vary r.motion=simplified,point --csv " + folder.path("t.csv"));
    EXPECT_EQ(result.exit_code, 0) << result.output;
    return result.output;
  };
  const std::string of_arm = run("model: " MURO_TEST_SOURCE_DIR "/examples/models/arm.urdf");
  for (const char* title : {"links, m", "joints, rad", "joints, m"})
    EXPECT_NE(of_arm.find(title), std::string::npos) << of_arm;
  EXPECT_NE(test::text_of(folder.path("t.csv"))
                .find(",heading_largest_rad,link_rms_m,link_largest_m,joint_rms_rad,joint_largest_rad,joint_rms_m,"
                      "joint_largest_m,first_contact_s,"),
            std::string::npos);
  const std::string of_ball = run("shape: {sphere: 0.1}, mass: 1");
  for (const char* title : {"links, m", "joints, "}) EXPECT_EQ(of_ball.find(title), std::string::npos) << of_ball;
  EXPECT_NE(test::text_of(folder.path("t.csv")).find(",0,0,0,,,,,,,"), std::string::npos) << "empty for a ball";
}

TEST(Compare, DrawsAPointForEachLevel) {
  const test::ScratchFolder folder;
  const std::string file = folder.path("picture.svg");
  const auto result = test::run_command(muro_program + urban + "--vary rovers.motion=point,simplified --out " + file);
  EXPECT_EQ(result.exit_code, 0) << result.output;
  const std::string text = test::text_of(file);
  EXPECT_NE(text.find(">point</text>"), std::string::npos);
  EXPECT_NE(text.find(">simplified (reference)</text>"), std::string::npos);
  const std::regex circle("<circle");
  EXPECT_EQ(std::distance(std::sregex_iterator(text.begin(), text.end(), circle), {}), 2);
}

}  // namespace
}  // namespace muro::host
