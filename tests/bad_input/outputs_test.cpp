// SPDX-License-Identifier: MIT
// The program writes its outputs and nothing else, also with two names of one file, links, pipes and full disks.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>

#include "muro_program.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"

namespace muro {
namespace {

namespace fs = std::filesystem;
using test::run_command;
using test::text_of;

/// A folder with the scenario of a ball. Commands run in this folder, and messages name it FOLDER.
struct Ball {
  test::ScratchFolder folder;
  explicit Ball(const std::string& algorithms = "{}") {
    folder.file("s.yaml",
                "duration: 1\nrobots: {ball: {shape: {sphere: 0.5}, mass: 1, motion: {use: motion.point, rate: "
                "100}}}\nalgorithms: " +
                    algorithms + "\n");
  }
  test::CommandResult run(const std::string& command) const {
    return run_command("cd " + folder.path("") + " && " + command);
  }
  test::CommandResult muro(const std::string& arguments) const { return run(muro_program + " " + arguments); }
  std::set<std::string> names() const {
    std::set<std::string> all;
    for (const auto& entry : fs::directory_iterator(folder.path(""))) all.insert(entry.path().filename());
    return all;
  }
};

constexpr const char* recorder = "{log: {use: recorder.csv, rate: 100, file: log.csv}}";

TEST(Outputs, OfOneNameAreRefusedBeforeTheRun) {
  const Ball ball(
      "{log: {use: recorder.csv, rate: 100, file: log.csv}, log2: {use: recorder.csv, rate: 100, file: "
      "./log.csv}}");
  for (const char* command : {"check", "run", "describe"}) {
    const auto result = ball.muro(std::string(command) + " s.yaml");
    EXPECT_EQ(result.exit_code, 2);
    EXPECT_SAYS(result.output,
                "log (recorder.csv, s.yaml:3:19) and log2 (recorder.csv, s.yaml:3:72) write to one file, ");
  }
  EXPECT_EQ(ball.muro("run s.yaml --set algorithms.log2=off --report log.csv").exit_code, 2);
  EXPECT_EQ(ball.muro("run s.yaml --set algorithms.log2=off --report x --timeline x").exit_code, 2);
  EXPECT_EQ(ball.names(), std::set<std::string>{"s.yaml"});
}

TEST(Outputs, DoNotReplaceWhatIsRead) {
  const Ball ball;
  const std::string scenario = text_of(ball.folder.path("s.yaml"));
  ball.folder.file("all.yaml", "include: s.yaml\n");
  fs::create_symlink("s.yaml", ball.folder.path("link"));
  for (const char* arguments :
       {"run s.yaml --report s.yaml", "run s.yaml --report link", "run s.yaml --timeline ./s.yaml",
        "run all.yaml --report s.yaml", "run all.yaml --report all.yaml",
        "compare s.yaml --vary ball.motion=point,simplified --csv s.yaml",
        "run s.yaml --set 'algorithms.log={use: recorder.csv, rate: 1, file: s.yaml}'"}) {
    const auto result = ball.muro(arguments);
    EXPECT_EQ(result.exit_code, 2) << arguments;
    EXPECT_SAYS(result.output, "would overwrite ");
    EXPECT_SAYS(result.output, "a file of the scenario; choose another name");
  }
  EXPECT_EQ(text_of(ball.folder.path("s.yaml")), scenario);
  EXPECT_EQ(ball.names(), (std::set<std::string>{"all.yaml", "link", "s.yaml"}));
}

TEST(Outputs, LeaveModelsAlone) {
  const Ball ball;
  ball.folder.file("m.urdf",
                   "<robot name=\"m\"><link name=\"l\"><inertial><mass value=\"1\"/><inertia ixx=\"1\" "
                   "ixy=\"0\" ixz=\"0\" iyy=\"1\" iyz=\"0\" izz=\"1\"/></inertial></link></robot>");
  ball.folder.file("model.yaml", "robots: {m: {model: m.urdf, motion: {use: motion.point}}}\n");
  const auto result = ball.muro("run model.yaml --report m.urdf");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.output, "--report would overwrite m.urdf, a model; choose another name\n");
}

TEST(Outputs, OfACheckAreNone) {
  const Ball ball(recorder);
  EXPECT_EQ(ball.muro("check s.yaml").exit_code, 0);
  EXPECT_EQ(ball.muro("describe s.yaml").exit_code, 0);
  EXPECT_EQ(ball.muro("check s.yaml --set algorithms.log.file=nowhere/log.csv").exit_code, 2);
  EXPECT_EQ(ball.names(), std::set<std::string>{"s.yaml"});
}

TEST(Outputs, LeaveFilesOfTheUserAlone) {
  const Ball ball(recorder);
  ball.folder.file("log.csv.part", "mine");
  ball.folder.file("r.json.part", "mine");
  EXPECT_EQ(ball.muro("run s.yaml --report r.json").exit_code, 0);
  EXPECT_EQ(text_of(ball.folder.path("log.csv.part")), "mine");
  EXPECT_EQ(text_of(ball.folder.path("r.json.part")), "mine");
  EXPECT_EQ(ball.names(), (std::set<std::string>{"log.csv", "log.csv.part", "r.json", "r.json.part", "s.yaml"}));
}

TEST(Outputs, MayBePipesAndLinksWhichStay) {
  const Ball ball(recorder);
  fs::create_symlink("target.json", ball.folder.path("link.json"));
  const auto result =
      ball.run("mkfifo pipe && (cat pipe >seen & " + muro_program + " run s.yaml --report pipe >/dev/null 2>&1; wait)");
  EXPECT_EQ(result.output, "");
  EXPECT_EQ(nlohmann::json::parse(text_of(ball.folder.path("seen"))).at("simulated_s"), 1);
  EXPECT_TRUE(fs::is_fifo(ball.folder.path("pipe")));
  EXPECT_EQ(ball.muro("run s.yaml --report link.json").exit_code, 0);
  EXPECT_TRUE(fs::is_symlink(ball.folder.path("link.json")));
  EXPECT_EQ(nlohmann::json::parse(text_of(ball.folder.path("target.json"))).at("simulated_s"), 1);
  EXPECT_EQ(
      ball.run(muro_program + " run s.yaml --duration 0 --report /dev/stdout >all 2>/dev/null; head -c 2 all").output,
      "{\n");
  EXPECT_SAYS(text_of(ball.folder.path("all")), "}\ns: 0 s simulated");
}

TEST(Outputs, AReaderThatLeavesIsAFailure) {
  const Ball ball(
      "{log: {use: recorder.csv, rate: 100, file: log.csv}, pipe: {use: recorder.csv, rate: 100, file: p}}");
  const auto result = ball.run("mkfifo p && (head -c 1 p >/dev/null & " + muro_program +
                               " run s.yaml --duration 100 >/dev/null; echo $?; wait)");
  EXPECT_SAYS(result.output, "p cannot be written: Broken pipe");
  EXPECT_SAYS(result.output, "\n1\n");
  EXPECT_FALSE(fs::exists(ball.folder.path("log.csv.part"))) << "the other recording is complete";
}

TEST(Outputs, OnAFullDiskTheFirstCauseIsTold) {
  const Ball ball(recorder);
  ball.folder.file("log.csv", "of the last run");
  const auto result = ball.run("(ulimit -f 64; " + muro_program +
                               " run s.yaml --duration 100 --report r.json --timeline t.json >/dev/null)");
  EXPECT_EQ(result.exit_code, 1) << result.output;
  const std::string name = "file " + ball.folder.path("log.csv") + " cannot be written: File too large\n";
  EXPECT_SAYS(result.output, name);
  EXPECT_LT(result.output.find(name), result.output.find("file t.json cannot be written: File too large\n"));
  EXPECT_EQ(text_of(ball.folder.path("log.csv")), "of the last run");
  EXPECT_EQ(nlohmann::json::parse(text_of(ball.folder.path("r.json"))).count("error"), 1u);
  EXPECT_FALSE(fs::exists(ball.folder.path("t.json")));
}

TEST(Outputs, ThatCannotBePrintedAreAFailure) {
  const Ball ball;
  for (const char* command :
       {"check s.yaml", "describe s.yaml", "describe s.yaml --json", "plugins list --json", "plugins info motion.point",
        "properties --markdown", "run s.yaml --report r.json", "compare s.yaml --vary ball.motion=point", "--help"}) {
    const auto result = ball.run("(" + muro_program + " " + command + " >/dev/full)");
    EXPECT_EQ(result.exit_code, 1) << command;
    EXPECT_SAYS(result.output, "standard output cannot be written: No space left on device\n");
  }
  EXPECT_EQ(nlohmann::json::parse(text_of(ball.folder.path("r.json"))).at("simulated_s"), 1) << "written nevertheless";
  EXPECT_EQ(ball.run(muro_program + " properties | head -c 1 >/dev/null; echo done").output, "done\n");
}

TEST(Outputs, DoNotTakeThePlaceOfClosedStreams) {
  const Ball ball(recorder);
  EXPECT_EQ(ball.run("(" + muro_program + " run s.yaml >&- 2>/dev/null; echo $?) 2>&1").output, "1\n");
  EXPECT_EQ(ball.run(muro_program + " run s.yaml 2>&- >/dev/null; echo $?").output, "0\n");
  EXPECT_EQ(text_of(ball.folder.path("log.csv")).find("state hash"), std::string::npos);
}

TEST(Outputs, WithNamesOfAnyBytesAreWritten) {
  const Ball ball(recorder);
  fs::rename(ball.folder.path("s.yaml"), ball.folder.path("caf\xe9.yaml"));
  const auto result = ball.muro("run caf\xe9.yaml --report caf\xe9.json --timeline t.json");
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(nlohmann::json::parse(text_of(ball.folder.path("caf\xe9.json"))).at("scenario"), "caf\xef\xbf\xbd");
  EXPECT_TRUE(nlohmann::json::accept(text_of(ball.folder.path("t.json"))));
}

TEST(Outputs, AreClosedWhenTheTerminalHangsUp) {
  const Ball ball(recorder);
  const auto result =
      ball.run("(" + muro_program +
               " run s.yaml --speed real --duration 1000 --report r.json >/dev/null 2>&1 & pid=$!; "
               "while [ ! -e log.csv.part ]; do sleep 0.1; done; sleep 0.5; kill -HUP $pid; wait $pid; echo $?)");
  EXPECT_EQ(result.output, "130\n");
  EXPECT_EQ(nlohmann::json::parse(text_of(ball.folder.path("r.json"))).at("interrupted"), true);
  EXPECT_EQ(ball.names(), (std::set<std::string>{"log.csv", "r.json", "s.yaml"}));
}

TEST(Errors, ThatFollowFromAnotherAreNotTold) {
  const Ball ball;
  const auto result = ball.muro("check s.yaml --set robots.ball.motoin.use=motion.point");
  EXPECT_EQ(result.exit_code, 2);
  EXPECT_EQ(result.output,
            "--set robots.ball.motoin.use=motion.point: robot `ball` has a second motion, `motoin` (did you mean "
            "`motion`?); `motion` (s.yaml:2:56) moves it already: remove one of them, or write them as `levels` of one "
            "motion\n");
  ball.folder.file(
      "arm.urdf",
      R"(<robot name="arm"><link name="stand"/><link name="boom"/><joint name="shoulder" type="continuous">)"
      R"(<parent link="stand"/><child link="boom"/><axis xyz="0 1 0"/></joint></robot>)");
  ball.folder.file("arm.yaml",
                   "robots:\n  arm: {model: arm.urdf,\n        motion: {use: motion.simplified, joints: effort},\n"
                   "        servo: {use: motor.servo, stiffness: 10, joints: [shoulder]}}\n");
  const auto follows = ball.muro("check arm.yaml");
  EXPECT_EQ(follows.exit_code, 2);
  EXPECT_EQ(follows.output.find("arm.yaml:3:17: arm.motion (motion.simplified) cannot be connected: `arm` has no mass"),
            0u)
      << follows.output;
  EXPECT_EQ(std::count(follows.output.begin(), follows.output.end(), '\n'), 1) << follows.output;
}

}  // namespace
}  // namespace muro
