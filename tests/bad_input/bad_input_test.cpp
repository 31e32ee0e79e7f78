// SPDX-License-Identifier: MIT
// Wrong scenarios, as a user would hand them to the program: each has its exact message beside it in
// scenarios/NAME.expected (FILE stands for the scenario's path), exit code 2, and no other output.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

#include "tests/support/files.hpp"

namespace muro {
namespace {

namespace fs = std::filesystem;
using test::run_command;

const std::string folder = MURO_TEST_SOURCE_DIR "/tests/bad_input/scenarios";
const std::string muro_program = std::string("MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " ") + MURO_PROGRAM;

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& f : fs::directory_iterator(folder))
    if (f.path().extension() == ".yaml") all.push_back(f.path().stem().string());
  std::sort(all.begin(), all.end());
  return all;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) text.replace(at, from.size(), to);
}

class WrongScenario : public ::testing::TestWithParam<std::string> {};

TEST_P(WrongScenario, HasItsExactMessageAndExitCode2) {
  const std::string path = folder + "/" + GetParam() + ".yaml";
  const auto result = run_command("cd " MURO_TEST_SOURCE_DIR " && " + muro_program + " check tests/bad_input/scenarios/" + GetParam() + ".yaml");
  std::string expected = test::text_of(folder + "/" + GetParam() + ".expected");
  ASSERT_FALSE(expected.empty()) << "write the message a user should see to " << GetParam() << ".expected";
  replace_all(expected, "SOURCE", MURO_TEST_SOURCE_DIR);
  replace_all(expected, "PLUGINS", MURO_TEST_PLUGIN_DIR);
  EXPECT_EQ(result.output, expected);
  EXPECT_EQ(result.exit_code, 2);
}

INSTANTIATE_TEST_SUITE_P(BadInput, WrongScenario, ::testing::ValuesIn(names()), [](const auto& test) { return test.param; });

TEST(WrongCommandLine, EndsWithExitCode2AndSaysWhatIsAllowed) {
  for (const char* arguments : {"", "fly", "run", "run x.yaml --speed", "run x.yaml --threads 0", "run x.yaml --duration -1", "plugins",
                                "plugins info", "check a b"}) {
    const auto result = run_command(muro_program + " " + arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_FALSE(result.output.empty()) << arguments;
  }
}

TEST(WrongCommandLine, AReportThatCannotBeWrittenIsToldBeforeTheRun) {
  const auto result = run_command("cd " MURO_TEST_SOURCE_DIR " && " + muro_program +
                                  " run examples/urban/urban.yaml --duration 1000 --report /nowhere/report.json");
  EXPECT_EQ(result.output,
            "file /nowhere/report.json cannot be written; is the folder there, may you write to it, is there room?\n");
  EXPECT_EQ(result.exit_code, 2);
}

TEST(WrongCommandLine, ASpeedMustBeMaxRealOrAFactor) {
  const auto result =
      run_command("cd " MURO_TEST_SOURCE_DIR " && " + muro_program + " run examples/urban/urban.yaml --speed fast");
  EXPECT_EQ(result.output, "--speed is `fast` but must be max, real or a factor such as 0.5\n");
  EXPECT_EQ(result.exit_code, 2);
}

}  // namespace
}  // namespace muro
