// SPDX-License-Identifier: MIT
// Messages and exit of the program when foreign code crashes, hangs, exits or throws, and when a run is interrupted.
#include <gtest/gtest.h>

#include <unistd.h>

#include <csignal>
#include <filesystem>

#include "core/simulation.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"

namespace muro {
namespace {

using test::run_command;

const std::string program = std::string("MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " ") + MURO_PROGRAM;

/// A run of some balls that a foreign library steers, while a recorder writes.
struct SteeredRun {
  test::ScratchFolder scratch;
  std::string record = scratch.path("record.csv"), scenario;
  test::CommandResult result;

  explicit SteeredRun(const std::string& arguments, const std::string& options = "",
                      const std::string& library = "misbehaves", int balls = 3) {
    scenario = scratch.file("s.yaml", "robots:\n  ball:\n    count: " + std::to_string(balls) +
                                          "\n    shape: {sphere: 0.1}\n    mass: 1\n    place: {grid: {count: [20, "
                                          "20], spacing: [1, 1]}}\n    motion: {use: motion.point}\n    control: {use: "
                                          "controller.library, rate: 10, library: " CONTROLLERS "/" +
                                          library + ".so, arguments: [" + arguments +
                                          "]}\nalgorithms:\n  log: {use: recorder.csv, rate: 10, file: " + record +
                                          ", properties: [\"ball_1/body:pose\"]}\n");
    result = run_command(program + " run " + scenario + " --duration 1 " + options);
  }
  /// Returns the description of the call in a message; `function`: of the library.
  std::string call(const std::string& what, const std::string& function, const std::string& time) const {
    return scenario + ":8:14: ball.control (controller.library), robot `ball_1`, " + what + " in `" + function +
           "` of " CONTROLLERS "/misbehaves.so at t = " + time + " s";
  }
};

struct Crash {
  const char *deed, *text;
  int signal;
};

class Crashing : public ::testing::TestWithParam<Crash> {};

TEST_P(Crashing, ControlCodeIsNamedWithRobotAndTime) {
  const auto& [deed, text, signal] = GetParam();
  const SteeredRun run(std::string("does=") + deed);
  EXPECT_SAYS(run.result.output, run.call("crashed", "step", "0.200000") + ": " + text);
  EXPECT_SAYS(run.result.output, "controllers/misbehaves.so(");  // in the call stack
#ifndef MURO_SANITIZED
  EXPECT_EQ(run.result.exit_code, 128 + signal) << run.result.output;
  EXPECT_TRUE(std::filesystem::exists(run.record + ".part"));
#endif
  EXPECT_EQ(test::text_of(run.record), "") << "the record is not whole";
}

const Crash crashes[] = {{"invalid_memory", "SIGSEGV, invalid memory access at 0x10; ", SIGSEGV},
                         {"gives_up", "SIGABRT, ", SIGABRT},
                         {"divides_by_zero", "SIGFPE, ", SIGFPE},
                         {"invalid_instruction", "SIGILL, ", SIGILL},
                         {"lost_memory", "SIGBUS, ", SIGBUS},
                         {"endless_recursion", "SIGSEGV, ", SIGSEGV}};
INSTANTIATE_TEST_SUITE_P(Process, Crashing, ::testing::ValuesIn(crashes),
                         [](const auto& test) { return test.param.deed; });

TEST(Crash, InAnyOfSeveralThreadsNamesTheRobot) {
  const SteeredRun run("does=endless_recursion", "--threads 4", "misbehaves", 200);
  EXPECT_SAYS(run.result.output, run.call("crashed", "step", "0.200000") + ": SIGSEGV");
}

TEST(Crash, BeforeTheFirstStepNamesTheFunction) {
  const SteeredRun run("does=invalid_memory, when=create");
  EXPECT_SAYS(run.result.output, run.call("crashed", "create", "0.000000") + ": SIGSEGV");
}

TEST(Crash, InAThreadOfALibrarySaysSo) {
  const SteeredRun run("does=thread_of_its_own");
  EXPECT_SAYS(run.result.output, "a thread crashed that a library has started: SIGSEGV, invalid memory access at 0x10");
}

TEST(Crash, OfAPluginNamesTheOneRobotOfMany) {
  const test::ScratchFolder scratch;
  const std::string file = scratch.file("s.yaml",
                                        "robots:\n  ball: {count: 40, shape: {sphere: 0.1}, mass: 1, place: {grid: "
                                        "{count: [20, 20], spacing: [1, 1]}}, motion: {use: motion.point}, eye: {use: "
                                        "sensor.crashes, rate: 10}}\n");
  const auto result = run_command(program + " --plugin-path " PLUGINS " run " + file + " --duration 1");
  EXPECT_SAYS(result.output, file + ":2:");
  EXPECT_SAYS(result.output, "ball.eye (sensor.crashes), robot `ball_7`, crashed in `step` of " PLUGINS
                             "/fails.so at t = 0.300000 s: SIGILL");
}

TEST(Exit, ByControlCodeIsNoSuccess) {
  for (const char* deed : {"leaves", "leaves_quickly"}) {
    const SteeredRun run(std::string("does=") + deed);
    EXPECT_SAYS(run.result.output, run.call("ended the program by exit()", "step", "0.200000"));
    EXPECT_EQ(run.result.exit_code, 1);
    EXPECT_EQ(test::text_of(run.record), "");
  }
}

TEST(Exit, AtOnceByControlCodeIsNoSuccess) {
  const SteeredRun run("does=leaves_at_once");
  EXPECT_SAYS(run.result.output, run.call("ended the program by _exit()", "step", "0.200000"));
  EXPECT_EQ(run.result.exit_code, 1);
}

TEST(Memory, ThatASceneLacksIsAnErrorOfThatScene) {
  const test::ScratchFolder scratch;
  const std::string file = scratch.file("s.yaml",
                                        "world: {objects: {ground: {shape: plane}}}\n"
                                        "robots:\n  ball: {count: 40000, shape: {sphere: 0.1}, mass: 1, place: {grid: "
                                        "{count: [200, 200], spacing: [1, 1]}}, motion: {use: motion.simplified}}\n");
  for (const int megabytes : {300, 450}) {
    const auto result = run_command("ulimit -v " + std::to_string(1000 * megabytes) + "; " + program + " run " + file +
                                    " --duration 0.01 --threads 1");
    EXPECT_EQ(result.exit_code, 2) << megabytes << ": " << result.output;
    EXPECT_SAYS(result.output, "the scene needs more memory than there is; make it smaller");
  }
}

TEST(Exit, WhileALibraryIsLoadedIsNoSuccess) {
  const SteeredRun run("", "", "leaves_when_loaded");
  EXPECT_SAYS(run.result.output,
              "ball.control (controller.library) ended the program by exit() in `load` of " CONTROLLERS
              "/leaves_when_loaded.so;");
  EXPECT_EQ(run.result.exit_code, 1);
}

TEST(Hang, IsEndedByTheStepTimeoutAndNamed) {
  const SteeredRun run("does=hangs", "--step-timeout 0.2");
  EXPECT_SAYS(run.result.output,
              run.call("hangs", "step", "0.200000") + ": it has not returned for 0.200000 s (--step-timeout); files");
  EXPECT_SAYS(run.result.output, "controllers/misbehaves.so(");
  EXPECT_EQ(run.result.exit_code, 1);
}

TEST(Hang, AStepTimeoutLeavesARunThatReturnsAlone) {
  const SteeredRun run("does=interrupts", "--step-timeout 100");
  EXPECT_EQ(run.result.exit_code, 130) << run.result.output;
  for (const char* wrong : {"0", "nan", "-1", "soon"})
    EXPECT_EQ(run_command(program + " run " + run.scenario + " --step-timeout " + wrong).exit_code, 2) << wrong;
}

const std::string isolated = "--set robots.ball.control.isolate=process ";
const std::string impatient = isolated + "--set robots.ball.control.timeout=0.2 ";

TEST(Isolation, OfControlCodeMakesAFailureOfWhateverItDoes) {
  for (const auto& [deed, cause] : {std::pair{"invalid_memory", "crashed in `step`: SIGSEGV, invalid memory access"},
                                    {"endless_recursion", "crashed in `step`: SIGSEGV"},
                                    {"thread_of_its_own", "crashed in `step`: SIGSEGV"},
                                    {"leaves", "ended its process in `step`: exit code 0"},
                                    {"hangs", "did not return from `step` within 0.2 s"}}) {
    const std::string does = std::string("does=") + deed;
    const SteeredRun run(does, deed == std::string("hangs") ? impatient : isolated);
    EXPECT_SAYS(run.result.output, run.scenario +
                                       ":8:14: ball.control (controller.library) failed at t = 0.200000 s: "
                                       "robot `ball_1`: `misbehaves` " +
                                       cause);
    EXPECT_EQ(run.result.exit_code, 1) << run.result.output;
  }
}

TEST(Isolation, OfControlCodeKeepsARunGoingWhereThatIsWanted) {
  const SteeredRun run("does=invalid_memory", isolated + "--set robots.ball.control.on_failure=hold");
  EXPECT_EQ(run.result.exit_code, 0) << run.result.output;
  EXPECT_SAYS(run.result.output, "robot `ball_1`: `misbehaves` crashed in `step`");
  EXPECT_NE(test::text_of(run.record), "");
}

TEST(Isolation, LeavesNoProcessOfControlCodeWhenTheProgramIsKilled) {
  const SteeredRun run("does=hangs", impatient);
  const std::string token = "MURO_TEST_TOKEN=" + std::to_string(getpid());
  const auto result = run_command(
      token + " " + program + " run " + run.scenario + " --duration 100 --speed 1 " +
      "--set robots.ball.control.isolate=process --set robots.ball.control.timeout=1000 >/dev/null 2>&1 & victim=$!\n" +
      "count() { grep -lzs '^" + token + "$' /proc/[0-9]*/environ | wc -l; }\n" +
      "for i in $(seq 100); do [ $(count) -ge 4 ] && break; sleep 0.05; done; echo before $(count)\n" +
      "sleep 0.3; kill -9 $victim; wait $victim\n" +
      "for i in $(seq 100); do [ $(count) -eq 0 ] && break; sleep 0.05; done; echo after $(count)");
  EXPECT_SAYS(result.output, "before 4\n") << "one for each ball";
  EXPECT_SAYS(result.output, "after 0\n") << "also of the one that hangs";
}

/// FMI programs write results from 0 to 1 s at 10 Hz in 11 rows, with one at the end.
TEST(EndOfARun, HasARowWhereThatIsWanted) {
  const test::ScratchFolder scratch;
  const std::string record = scratch.path("record.csv");
  const std::string scenario = scratch.file(
      "s.yaml",
      "robots:\n  ball: {shape: {sphere: 0.1}, mass: 1, motion: {use: motion.point}}\nalgorithms:\n  log: {use: "
      "recorder.csv, rate: 10, file: " +
          record + ", properties: [\"ball/body:pose\"]}\n");
  const auto rows = [&](const std::string& options) {
    const auto result = run_command(program + " run " + scenario + " --duration 1 " + options);
    EXPECT_EQ(result.exit_code, 0) << result.output;
    EXPECT_SAYS(result.output, "s: 1 s simulated");
    return test::text_of(record);
  };
  const std::string without = rows(""), with = rows("--include-end");
  EXPECT_TRUE(with.starts_with(without));
  const std::string last = with.substr(without.size());
  EXPECT_TRUE(last.starts_with("1,")) << last;
  EXPECT_EQ(std::count(last.begin(), last.end(), '\n'), 1);
}

TEST(Interrupt, EndsARunWithItsRecordsWhole) {
  for (const char* deed : {"interrupts", "hangs_up"}) {
    const SteeredRun run(std::string("does=") + deed);
    EXPECT_EQ(run.result.exit_code, 130) << run.result.output;
    EXPECT_SAYS(run.result.output, ", interrupted");
    EXPECT_SAYS(test::text_of(run.record), "0.2,");
  }
}

TEST(Interrupt, ForTheSecondTimeEndsAtOnceAndSaysWhatRan) {
  const SteeredRun run("does=interrupts_twice");
  EXPECT_EQ(run.result.exit_code, 128 + SIGINT) << run.result.output;
  EXPECT_SAYS(run.result.output, "ended while this was busy: " + run.scenario +
                                     ":8:14: ball.control (controller.library), robot `ball_1`, in `step` of ");
  EXPECT_EQ(test::text_of(run.record), "");
}

TEST(StandardError, ThatNobodyReadsChangesNoExitCode) {
  const SteeredRun run("does=interrupts");
  const auto exit_code = [&](const std::string& arguments) {
    // the reader has ended before the program begins
    return run_command("{ { sleep 0.2; " + program + " " + arguments +
                       "; echo $? >&3; } 2>&1 >/dev/null | true; } 3>&1")
        .output;
  };
  EXPECT_EQ(exit_code("check " + run.scenario), "0\n");
  EXPECT_EQ(exit_code("check " + run.scratch.path("none.yaml")), "2\n");
  EXPECT_EQ(exit_code("run " + run.scenario + " --duration 1"), "130\n");
}

/// Runs balls with a sensor of this kind, which fails for ball_7.
test::CommandResult run_with_eye(const test::ScratchFolder& scratch, const std::string& sensor) {
  const std::string file =
      scratch.file("s.yaml",
                   "robots:\n  ball:\n    count: 40\n    shape: {sphere: 0.1}\n    mass: 1\n    place: {grid: {count: "
                   "[20, 20], spacing: [1, 1]}}\n    motion: {use: motion.point}\n"
                   "    eye: {use: " +
                       sensor + ", rate: 10}\n");
  return run_command(program + " --plugin-path " PLUGINS " run " + file + " --duration 1");
}

TEST(Failure, NamesPlaceAlgorithmRobotAndTime) {
  const test::ScratchFolder scratch;
  const auto result = run_with_eye(scratch, "sensor.throws");
  EXPECT_SAYS(result.output, scratch.path("s.yaml") +
                                 ":8:10: ball.eye (sensor.throws), robot `ball_7`, failed at t = "
                                 "0.300000 s: the lens is dirty\n");
  EXPECT_EQ(result.exit_code, 1);
}

TEST(Log, NamesPlaceAlgorithmRobotAndTime) {
  const test::ScratchFolder scratch;
  const auto result = run_with_eye(scratch, "sensor.says");
  EXPECT_SAYS(result.output, "warning: " + scratch.path("s.yaml") +
                                 ":8:10: ball.eye (sensor.says), robot `ball_7`, t = 0.300000 s: the lens is dirty\n");
  EXPECT_EQ(result.exit_code, 0);
}

TEST(Embedding, LeavesTheSignalsOfTheProcessAlone) {
  const auto handlers = [] {
    std::vector<void*> all;
    for (const int number : {SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT, SIGINT, SIGTERM, SIGHUP, SIGPIPE}) {
      struct sigaction action {};
      sigaction(number, nullptr, &action);
      all.push_back(reinterpret_cast<void*>(action.sa_handler));
    }
    return all;
  };
  const auto before = handlers();
  Registry registry({MURO_TEST_PLUGIN_DIR});
  Simulation simulation(registry);
  RobotTree tree;
  tree.base("base");
  tree.close();
  const RobotView& robot = simulation.world().add_robot("rover", tree, {});
  simulation.use("motion.point", 100, {{&robot, robot.base()}});
  simulation.build();
  simulation.set_threads(3);
  simulation.run_for(1);
  EXPECT_EQ(handlers(), before);
}

}  // namespace
}  // namespace muro
