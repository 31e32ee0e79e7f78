// SPDX-License-Identifier: MIT
// `muro compare --against`: a scenario on the commands of a recording.
#include <gtest/gtest.h>

#include <algorithm>
#include <sstream>

#include "tests/support/files.hpp"

namespace muro::host {
namespace {

test::CommandResult compare_against(const std::string& arguments) {
  return test::run_command("cd " MURO_TEST_SOURCE_DIR " && MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " " MURO_PROGRAM
                           " compare examples/motors/bench.yaml " +
                           arguments);
}

/// The cells of the column `mean_error`.
std::vector<double> mean_errors(const std::string& csv) {
  std::vector<double> all;
  std::istringstream in(csv);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    std::string cell;
    for (int k = 0; k < 4; ++k) std::getline(cells, cell, ',');
    all.push_back(cell.empty() ? -1 : std::stod(cell));
  }
  return all;
}

TEST(CompareAgainst, TheMotorOfARecordingMissesItLeast) {
  const test::ScratchFolder folder;
  const auto error_with = [&](const std::string& more) {
    const auto r = compare_against("--against examples/motors/record_1.csv --csv " + folder.path("t.csv") + more);
    EXPECT_EQ(r.exit_code, 0) << r.output;
    const std::vector<double> errors = mean_errors(test::text_of(folder.path("t.csv")));
    return errors.empty() ? 1e9 : errors.front();
  };
  const double own = error_with("");
  EXPECT_LT(own, 0.012) << "the encoder's zero is off by 0.01 rad, and 0.001 of viscous friction is missing";
  EXPECT_GT(error_with(" --set robots.bench.motor.kt=0.8"), 3 * own);
  EXPECT_GT(error_with(" --set robots.bench.motor.part=mx64"), 3 * own);
}

TEST(CompareAgainst, EveryLevelGetsARowForEveryRecording) {
  const test::ScratchFolder folder;
  const auto r = compare_against(
      "--vary bench.motion=simplified,point --against examples/motors/record_1.csv "
      "examples/motors/record_2.csv --csv " +
      folder.path("t.csv") + " --out " + folder.path("t.svg"));
  EXPECT_EQ(r.exit_code, 1) << "a point has no joint that moves\n" << r.output;
  EXPECT_NE(r.output.find("all 2 records"), std::string::npos) << r.output;
  EXPECT_NE(r.output.find("did not run"), std::string::npos) << r.output;
  const std::vector<double> errors = mean_errors(test::text_of(folder.path("t.csv")));
  ASSERT_EQ(errors.size(), 4u);
  EXPECT_GT(errors[0], 0);
  EXPECT_EQ(errors[1], -1) << "no figure";
  EXPECT_NE(test::text_of(folder.path("t.svg")).find("record_2.csv simplified"), std::string::npos);
}

TEST(CompareAgainst, MistakesAreOneMessage) {
  const std::pair<std::string, std::string> cases[] = {
      {"", "--vary says what is compared, and is missing"},
      {"--against none.csv", "none.csv: there is no such file"},
      {"--against examples/motors/record_1.csv --joint bench/serfo",
       "there is no such joint (did you mean `bench/servo`?)"},
      {"--against examples/motors/bench.yaml", "bench.yaml:2:1: the header has no column `time`"},
  };
  for (const auto& [arguments, message] : cases) {
    const auto r = compare_against(arguments);
    EXPECT_EQ(r.exit_code, 2) << r.output;
    EXPECT_NE(r.output.find(message), std::string::npos) << message << "\n" << r.output;
  }
}

}  // namespace
}  // namespace muro::host
