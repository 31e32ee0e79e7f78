// SPDX-License-Identifier: MIT
// Wrong scenarios, as a user would give them to the program. Each has its exact message in scenarios/NAME.expected
// (FILE is the scenario's path, MOTIONS the list of motions that plugins offer). The exit code is 2, and there is no
// other output.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "muro_program.hpp"
#include "tests/support/files.hpp"

namespace muro {
namespace {

namespace fs = std::filesystem;
using test::run_command;

const std::string folder = MURO_TEST_SOURCE_DIR "/tests/bad_input/scenarios";

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const auto& f : fs::directory_iterator(folder))
    if (f.path().extension() == ".yaml") all.push_back(f.path().stem().string());
  std::sort(all.begin(), all.end());
  return all;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

/// Returns the motions of this build: "motion.ackermann, motion.bullet, ...".
std::string motions() {
  std::istringstream offers(run_command(muro_program + " plugins list").output);
  std::string all;
  for (std::string line; std::getline(offers, line);)
    if (line.rfind("motion.", 0) == 0) all += (all.empty() ? "" : ", ") + line.substr(0, line.find(' '));
  return all;
}

class WrongScenario : public ::testing::TestWithParam<std::string> {};

TEST_P(WrongScenario, HasItsExactMessageAndExitCode2) {
  const std::string path = folder + "/" + GetParam() + ".yaml";
  const auto result = run_command("cd " MURO_TEST_SOURCE_DIR " && " + muro_program +
                                  " check tests/bad_input/scenarios/" + GetParam() + ".yaml");
  std::string expected = test::text_of(folder + "/" + GetParam() + ".expected");
  ASSERT_FALSE(expected.empty()) << "write the message a user should see to " << GetParam() << ".expected";
  replace_all(expected, "SOURCE", MURO_TEST_SOURCE_DIR);
  replace_all(expected, "MOTIONS", motions());
  replace_all(expected, "PLUGINS", MURO_TEST_PLUGIN_DIR);
  EXPECT_EQ(result.output, expected);
  EXPECT_EQ(result.exit_code, 2);
}

INSTANTIATE_TEST_SUITE_P(BadInput, WrongScenario, ::testing::ValuesIn(names()),
                         [](const auto& test) { return test.param; });

TEST(WrongCommandLine, EndsWithExitCode2AndSaysWhatIsAllowed) {
  for (const char* arguments :
       {"", "run x.yaml --duration nan", "run x.yaml --duration long", "run x.yaml --seed -1", "run x.yaml --seed 1.5",
        "run", "run x.yaml --speed", "run x.yaml --threads 0", "run x.yaml --threads many", "run x.yaml --threads 2.5",
        "run x.yaml --timeline", "run x.yaml --duration -1", "plugins", "plugins info", "check a b"}) {
    const auto result = run_command(muro_program + " " + arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_FALSE(result.output.empty()) << arguments;
  }
}

TEST(WrongCommandLine, AReportThatCannotBeWrittenIsRefusedBeforeTheRun) {
  const auto result = run_command("cd " MURO_TEST_SOURCE_DIR " && " + muro_program +
                                  " run examples/urban/urban.yaml --duration 1000 --report /nowhere/report.json");
  EXPECT_EQ(result.output, "--report: file /nowhere/report.json cannot be written: No such file or directory\n");
  EXPECT_EQ(result.exit_code, 2);
}

TEST(WrongCommandLine, ASpeedMustBeMaxRealOrAFactor) {
  const auto result =
      run_command("cd " MURO_TEST_SOURCE_DIR " && " + muro_program + " run examples/urban/urban.yaml --speed fast");
  EXPECT_EQ(result.output, "--speed is `fast` but must be max, real or a factor from 1e-6 to 1e6, such as 0.5\n");
  EXPECT_EQ(result.exit_code, 2);
  for (const char* speed : {"nan", "inf", "0", "-1", "1e-300", "1e7", "1x", "\"\""})
    EXPECT_EQ(run_command("cd " MURO_TEST_SOURCE_DIR " && " + muro_program +
                          " run examples/urban/urban.yaml --speed=" + speed)
                  .exit_code,
              2)
        << speed;
}

TEST(WrongCommandLine, ACommandThatDoesNotExistNamesThoseThatDo) {
  const auto result = run_command(muro_program + " chekc x.yaml");
  EXPECT_EQ(result.output,
            "muro has no command `chekc` (did you mean `check`?); commands: run, check, compare, identify, render, "
            "sensors, describe, plugins, properties\n");
  EXPECT_EQ(result.exit_code, 2);
}

/// Run of a ball with a recorder, whose motion ends with an error, or with a pose that is not a number.
struct FailedRun {
  test::ScratchFolder scratch;
  std::string report = scratch.path("report.json"), record = scratch.path("record.csv");
  test::CommandResult result;
  FailedRun(const std::string& motion, const std::string& plugin_path) {
    const std::string scenario =
        scratch.file("s.yaml", "robots:\n  ball: {shape: {sphere: 0.5}, mass: 1, motion: {use: " + motion +
                                   ", rate: 10}}\nalgorithms:\n  log: {use: "
                                   "recorder.csv, rate: 10, file: " +
                                   record + ", properties: [\"ball/body:pose\"]}\n");
    result = run_command(muro_program + " --plugin-path " + plugin_path + " run " + scenario + " --report " + report);
  }
};

TEST(WrongCommandLine, WithoutACommandTheCommandsAreNamed) {
  const auto result = run_command(muro_program);
  EXPECT_EQ(result.output,
            "muro needs a command: run, check, compare, identify, render, sensors, describe, plugins, properties; "
            "muro --help tells more\n");
  EXPECT_EQ(result.exit_code, 2);
}

TEST(InputsWithoutEnd, AreRefusedWithTheirBound) {
  const test::ScratchFolder scratch;
  const std::string scene = scratch.file("s.yaml", "duration: 0.1\n");
  for (const std::string& arguments :
       {"run " + scene + " --replay /dev/zero", std::string("identify /dev/zero --duty-gain 0.003")}) {
    const auto said = run_command(muro_program + " " + arguments);
    EXPECT_EQ(said.exit_code, 2) << arguments;
    EXPECT_NE(said.output.find("/dev/zero has "), std::string::npos) << said.output;
    EXPECT_NE(said.output.find(" MiB"), std::string::npos) << said.output;
  }
}

TEST(FailedRun, StillWritesItsReportAndItsRecords) {
  const FailedRun run("motion.step_throws", BAD_PLUGIN_DIR "/throws");
  EXPECT_EQ(run.result.exit_code, 1) << run.result.output;
  EXPECT_NE(test::text_of(run.report).find("\"error\": \""), std::string::npos);
  EXPECT_NE(test::text_of(run.record), "");
}

/// Files given as plugins or control code that are neither: the message names the file and what is wrong with it.
struct Broken {
  const char* arguments;
  const char* expected;  ///< beginning of the message; the loader writes the rest
};

class BrokenLibrary : public ::testing::TestWithParam<Broken> {};

TEST_P(BrokenLibrary, IsRefusedWithItsPathAndTheReason) {
  const auto result = run_command("cd " MURO_TEST_SOURCE_DIR " && " + muro_program +
                                  " check tests/bad_input/scenarios/" + GetParam().arguments);
  EXPECT_EQ(result.output.rfind(std::string("tests/bad_input/scenarios/") + GetParam().expected, 0), 0u)
      << result.output;
  EXPECT_EQ(result.exit_code, 2);
}

#define MURO_BROKEN_PLUGIN(name) \
  "unknown_algorithm.yaml --plugin-path " BAD_PLUGIN_DIR "/" name " --set robots.rover.motion.use=motion." name
INSTANTIATE_TEST_SUITE_P(
    BadInput, BrokenLibrary,
    ::testing::Values(
        Broken{MURO_BROKEN_PLUGIN("wrong_sdk_major"), "unknown_algorithm.yaml:5:13: plugin " BAD_PLUGIN_DIR
                                                      "/wrong_sdk_major/wrong_sdk_major.so was built for another "
                                                      "muro: sdk_major is "},
        Broken{MURO_BROKEN_PLUGIN("text_file"),
               "unknown_algorithm.yaml:5:13: plugin " BAD_PLUGIN_DIR "/text_file/text_file.so cannot be loaded: "},
        Broken{"missing_library.yaml --set robots.rover.control.library=" CONTROLLERS "/no_symbol.so",
               "missing_library.yaml:5:14: rover.control (controller.library) cannot be connected: library " CONTROLLERS
               "/no_symbol.so exports no `muro_controller`"}));

TEST(HalfCopiedLibrary, IsRefusedAndNotRun) {
  const test::ScratchFolder scratch;
  const auto half = [&](const std::string& path, const std::string& name) {
    const std::string bytes = test::text_of(path);
    scratch.file(name, bytes.substr(0, bytes.size() / 2));
  };
  half(BAD_PLUGIN_DIR "/throws/throws.so", "throws.so");
  half(CONTROLLERS "/no_symbol.so", "control.so");
  scratch.file("throws.muro.json", test::text_of(BAD_PLUGIN_DIR "/throws/throws.muro.json"));
  const std::string ball = "robots:\n  ball:\n    shape: {sphere: 0.5}\n    mass: 1\n";
  const std::string motion = scratch.file("motion.yaml", ball + "    motion: {use: motion.step_throws, rate: 10}\n");
  const std::string control =
      scratch.file("control.yaml", ball + "    control: {use: controller.library, rate: 10, library: control.so}\n");
  for (const std::string& arguments : {motion + " --plugin-path " + scratch.path(""), control}) {
    const auto result = run_command(muro_program + " check " + arguments);
    EXPECT_NE(result.output.find("it was copied only in part"), std::string::npos) << result.output;
    EXPECT_EQ(result.exit_code, 2);
  }
}

}  // namespace
}  // namespace muro
