// SPDX-License-Identifier: MIT
// Control code in separate processes: the effect of failures on the run, and otherwise the same results.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include "core/external/input_log.hpp"
#include "core/external/reported_numbers.hpp"
#include "library_testing.hpp"
#include "tests/support/processes.hpp"

namespace muro::control {
namespace {

/// A team whose control code runs in separate processes; robot `a` fails as `does` says.
struct Failing : Team {
  explicit Failing(const std::string& does, Settings settings = {}, Texts more = {}) {
    more.push_back("does=" + does);
    settings["arguments"] = more;
    if (!settings.contains("isolate")) settings["isolate"] = std::string("process");
    if (!settings.contains("timeout")) settings["timeout"] = 20.0;
    if (!settings.contains("memory")) settings["memory"] = std::int64_t(16);
    set_log([this](LogLevel, std::string_view line) { log += std::string(line) + "\n"; });
    control(folder + "fails.so", std::move(settings));
    build();
  }
  /// Returns the message with which a run ends.
  std::string run(double seconds = 1) {
    try {
      run_for(seconds);
    } catch (const StepError& e) {
      return e.what();
    }
    return "it went well";
  }
  /// Returns the process that robot `a` has printed.
  pid_t told() const {
    const std::size_t at = log.find("(prints) process ");
    return at == std::string::npos ? 0 : std::atoi(log.c_str() + at + 17);
  }
  std::string log;
};

TEST(IsolatedController, IsTheOnlyOneThatLimitsBound) {
  Failing alone("nothing", {{"isolate", std::string("none")}, {"timeout", 0.5}});
  EXPECT_TRUE(says(alone.log, "`timeout` and `memory` bound control code in a process of its own alone"));
  EXPECT_EQ(Failing("nothing").log.find("bound control code"), std::string::npos);
}

TEST(IsolatedController, EndsTheRunWithRobotTimeCauseAndStackWhenItCrashes) {
  Failing team("invalid_memory");
  const std::string said = team.run();
  EXPECT_TRUE(says(said, "failed at t = 0.2"));
  EXPECT_TRUE(says(said, "robot `a`: `fails` crashed in `step`: SIGSEGV, invalid memory access at 0x10"));
  EXPECT_TRUE(says(team.log, "robot `a`: `fails` was in these calls:\n"));
  EXPECT_TRUE(says(team.log, "controllers/fails.so("));
}

TEST(IsolatedController, IsEndedWhenItDoesNotReturn) {
  for (const char* how : {"loop", "sleep"}) {
    Failing team(how, {{"timeout", 0.2}});
    EXPECT_TRUE(
        says(team.run(), "robot `a`: `fails` did not return from `step` within 0.2 s of wall-clock time (`timeout`)"));
    EXPECT_TRUE(says(team.log, "controllers/fails.so(")) << "where it was";
  }
}

TEST(IsolatedController, FailsByAnErrorOrANumberThatIsNotFiniteAsElsewhere) {
  for (const auto& [argument, message] :
       {std::pair{"nan_at=3",
                  "robot `a`: output `command.twist` of `circle`[5] is not a number; outputs must be finite numbers"},
        {"fail_at=5", "robot `a`: `circle` fails: lost at x = "},
        {"tell=nothing", "robot `a`: `circle` fails without giving a reason"},
        {"tell=endless", "robot `a`: `circle` fails: xxxxxxxx"},
        {"tell=all", "robot `a`: `circle` fails: robot a, period 0.1, sizes 7"}}) {
    Team team;
    team.control(folder + "circle.so", {{"isolate", std::string("process")}, {"arguments", Texts{argument}}});
    team.build();
    try {
      team.run_for(2);
      ADD_FAILURE() << argument;
    } catch (const StepError& e) {
      EXPECT_TRUE(says(e.what(), message));
    }
  }
  Team held;
  held.set_log([](LogLevel, std::string_view) {});
  held.control(folder + "circle.so", {{"on_failure", std::string("hold")}, {"arguments", Texts{"nan_at=3"}}});
  held.build();
  held.run_for(2);
  EXPECT_EQ(held.command(*held.a).linear.x(), 0);
}

TEST(IsolatedController, MayFailBeforeItsFirstStep) {
  Failing late("loop", {{"timeout", 0.2}}, {"when=create"});
  EXPECT_TRUE(says(late.run(), "`fails` did not return from `create` within 0.2 s"));
  Failing crashed("invalid_memory", {{"on_failure", std::string("restart")}}, {"when=create"});
  EXPECT_EQ(crashed.run(), "it went well");
  EXPECT_TRUE(says(crashed.log,
                   "`fails` crashed in `create`: SIGSEGV, invalid memory access at 0x10; it begins anew, for "
                   "the 3. of 3 times"));
}

TEST(IsolatedController, IsReportedWithItsWayOfFailing) {
  for (const auto& [does, message] : {
           std::pair{"exit", "`fails` ended its process in `step`: exit code 3"},
           {"exit_at_once", "`fails` ended its process in `step`: exit code 0"},
           {"abort", "`fails` crashed in `step`: SIGABRT, it gave up by abort()"},
           {"recurse", "`fails` crashed in `step`: SIGSEGV, invalid memory access at 0x"},
           {"throw",
            "`fails` threw an exception out of `step`: a wheel is off; functions of control code throw nothing"},
           {"throw_a_number", "`fails` threw an exception out of `step`; functions of control code throw nothing"},
           {"throw_in_thread", "`fails` crashed in `step`: SIGABRT"},
           {"kill", "`fails` crashed in `step`: SIGKILL, maybe because the system was short of memory"},
       }) {
    Failing team(does);
    EXPECT_TRUE(says(team.run(), message));
  }
}

TEST(IsolatedController, IsRefusedMoreMemoryThanItMayTake) {
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  for (const char* how : {"allocate", "allocate_by_new"}) {
    Failing team(how);
    const std::string said = team.run();
    EXPECT_TRUE(says(said, "robot `a`: `fails` ran out of memory in `step`"));
    EXPECT_TRUE(says(said, "its process may take 16 MiB (`memory`) beside what it has at its start"));
  }
#endif
}

TEST(IsolatedController, WhatItPrintsIsALogLineOfItsRobot) {
  Failing team("print");
  EXPECT_EQ(team.run(), "it went well");
  EXPECT_TRUE(says(team.log, "robot `a`: `fails` says: (prints) to standard output\n"));
  EXPECT_TRUE(says(team.log, "robot `a`: `fails` says: (prints) to standard error\n"));
}

TEST(IsolatedController, PrintsABoundedNumberOfLines) {
  Failing team("print_endlessly");
  EXPECT_EQ(team.run(), "it went well");
  EXPECT_TRUE(says(team.log, "(prints) line 19\n"));
  EXPECT_TRUE(says(team.log, "(prints more, which is left out)\n"));
  EXPECT_LT(team.log.size(), 10000u);
}

TEST(IsolatedController, LeavesItsRobotAtRestAndTheOthersAloneWhereThatIsWanted) {
  for (const char* how : {"invalid_memory", "loop", "throw"}) {
    Failing team(how, {{"on_failure", std::string("hold")}, {"timeout", how == std::string("loop") ? 0.2 : 20.0}});
    EXPECT_EQ(team.run(), "it went well") << how;
    EXPECT_EQ(team.command(*team.a).linear.x(), 0) << how;
    EXPECT_EQ(team.command(*team.b).linear.x(), 1) << how;
    EXPECT_TRUE(says(team.log,
                     "from now on its commands of speed and effort are 0, and all others stay "
                     "(`on_failure: hold`)"));
  }
}

TEST(IsolatedController, BeginsAnewAsOftenAsIsAllowed) {
  Failing team("exit", {{"on_failure", std::string("restart")}, {"restarts", std::int64_t(2)}});
  team.run_for(0.4);
  EXPECT_EQ(team.command(*team.a).linear.x(), 1) << "in its first step after the failure";
  EXPECT_EQ(team.run(2), "it went well");
  EXPECT_TRUE(says(team.log, "it begins anew, for the 1. of 2 times"));
  EXPECT_TRUE(says(team.log, "it begins anew, for the 2. of 2 times"));
  EXPECT_TRUE(says(team.log, "all others stay (`on_failure: restart`, `restarts` are used up)"));
  EXPECT_EQ(team.command(*team.a).linear.x(), 0);
  EXPECT_EQ(team.command(*team.b).linear.x(), 1);
  team.finish();
  const auto& sections = team.reported_numbers().sections();
  ASSERT_EQ(sections.size(), 1u);
  EXPECT_EQ(sections[0].first, "control_code");
  ASSERT_EQ(sections[0].second.size(), 1u) << "of the robot that has failed";
  EXPECT_EQ(sections[0].second[0].first, "a/fails");
  using Numbers = ReportedNumbers::Numbers;
  EXPECT_EQ(sections[0].second[0].second, (Numbers{{"failures", 3}, {"restarts", 2}, {"held", 1}}));
}

TEST(IsolatedController, GoesOnFromASnapshotOfBeforeItsFailure) {
  Failing team("invalid_memory", {{"on_failure", std::string("hold")}});
  team.run_for(0.15);
  const Snapshot before = team.snapshot();
  team.run_for(1);
  const std::uint64_t end = team.state_hash();
  team.restore(before);
  team.run_for(0.05);
  EXPECT_EQ(team.command(*team.a).linear.x(), 1);
  team.run_for(0.95);
  EXPECT_EQ(team.state_hash(), end);
  team.reset();
  team.run_for(1.15);
  EXPECT_EQ(team.state_hash(), end);
}

TEST(IsolatedController, DoesTheSameToTheBitAsInTheSimulatorsProcess) {
  const auto hash = [](const char* isolate) {
    Team team;
    team.control(folder + "circle.so", {{"isolate", std::string(isolate)}, {"arguments", Texts{"name=x"}}});
    team.build();
    team.run_for(1);
    const Snapshot middle = team.snapshot();
    team.run_for(1.3);
    const std::uint64_t end = team.state_hash();
    team.restore(middle);
    team.run_for(1.3);
    EXPECT_EQ(team.state_hash(), end);
    team.reset();
    team.run_for(2.3);
    EXPECT_EQ(team.state_hash(), end);
    return end;
  };
  EXPECT_EQ(hash("process"), hash("none"));
}

TEST(IsolatedController, GivesTheSameBitsOnTwoThreads) {
  const auto hash = [](unsigned threads) {
    test::Scene s;
    const RobotTree tree = two_arms();
    for (int i = 0; i < 6; ++i) s.add("r" + std::to_string(i), tree, {{2.0 * i, 0, 0}, Quat::Identity()});
    s.use("motion.point", 20, s.all_robots());
    s.use("controller.library", 10, s.all_robots(),
          {{"library", folder + "circle.so"}, {"isolate", std::string("process")}});
    s.set_threads(threads);
    s.verify_access();
    s.build();
    s.run_for(3);
    return s.state_hash();
  };
  EXPECT_EQ(hash(1), hash(2));
}

TEST(IsolatedController, FailsAgainAtTheSameInstantsInAReplay) {
  const std::string recording = testing::TempDir() + "failures.csv";
  const auto run = [&](const char* use, const std::string& does) {
    Settings settings{{"on_failure", std::string("restart")}, {"arguments", Texts{"does=" + does}}};
    settings["isolate"] = std::string("process");
    settings["timeout"] = 0.2;
    Team team;
    team.set_log([](LogLevel, std::string_view) {});
    team.use(use, 10, {}, {{"file", recording}});
    team.control(folder + "fails.so", settings);
    team.build();
    team.run_for(2);
    const std::uint64_t hash = team.state_hash();
    team.finish();
    return hash;
  };
  const std::uint64_t recorded = run("recorder.inputs", "sleep");
  EXPECT_EQ(run("controller.replay", "nothing"), recorded) << "the clock has no say, and the recording has";
  EXPECT_NE(run("recorder.inputs", "nothing"), recorded);
}

TEST(IsolatedController, LeavesNoProcessBehind) {
  const std::size_t before = test::child_processes().size();
  {
    Failing team("kill", {{"on_failure", std::string("restart")}});
    EXPECT_EQ(test::child_processes().size(), before + 2) << "one a robot";
    team.run();
    Failing other("loop", {{"timeout", 0.2}});
    other.run();
  }
  EXPECT_EQ(test::child_processes().size(), before);
}

TEST(IsolatedController, TakesTheProcessesAlongThatItHasStarted) {
  for (const char* policy : {"stop", "hold", "restart"})
    for (const char* does :
         {"start_another", "start_another_and_crash", "start_another_and_leave", "start_another_and_loop"}) {
      const bool loops = does == std::string("start_another_and_loop");
      pid_t other = 0;
      {
        Failing team(does, {{"on_failure", std::string(policy)}, {"timeout", loops ? 0.2 : 20.0}});
        team.run_for(0.15);
        const std::string how = team.run();
        other = team.told();
        ASSERT_GT(other, 0) << team.log;
        if (does == std::string("start_another"))
          EXPECT_EQ(how, "it went well");
        else
          EXPECT_TRUE(test::ends_soon(other)) << does << " " << policy << ": with its parent";
      }
      EXPECT_TRUE(test::ends_soon(other)) << does << " " << policy << ": with the run";
    }
}

TEST(IsolatedController, ThatIsKilledFromOutsideMakesTheRunNotRepeatable) {
  for (const auto& [sent, reason] : {std::pair{SIGKILL,
                                               "SIGKILL, maybe because the system was short of memory, or because "
                                               "somebody killed it"},
                                     {SIGTERM, "SIGTERM"},
                                     {SIGSEGV, "SIGSEGV, invalid memory access"}}) {
    Failing team("tell_process");
    team.run_for(0.4);
    ASSERT_GT(team.told(), 0) << team.log;
    EXPECT_TRUE(team.inputs().reasons().empty());
    kill(team.told(), sent);
    EXPECT_TRUE(test::ends_soon(team.told()));
    EXPECT_TRUE(says(team.run(), std::string("robot `a`: `fails` crashed: ") + reason));
    ASSERT_EQ(team.inputs().reasons().size(), 1u);
    EXPECT_EQ(team.inputs().reasons()[0],
              std::string("robot `a`: `fails` was ended by a signal from outside: ") + reason);
  }
}

TEST(IsolatedController, ThatFailsByItselfLeavesTheRunRepeatable) {
  for (const char* does : {"invalid_memory", "abort", "exit", "throw"}) {
    Failing team(does);
    EXPECT_NE(team.run(), "it went well");
    EXPECT_TRUE(team.inputs().reasons().empty()) << does << ": " << team.inputs().reasons()[0];
  }
}

TEST(IsolatedController, WhoseCopyComesBackGoesOnWithoutTheCopy) {
  const auto hash = [] {
    Failing team("copy_itself");
    EXPECT_EQ(team.run(), "it went well");
    return team.state_hash();
  };
  const std::uint64_t first = hash();
  for (int i = 0; i < 10; ++i) EXPECT_EQ(hash(), first);
}

TEST(IsolatedController, MayCloseAllDescriptorsAndGoesOn) {
  Failing stopped("close_all_and_tell");
  stopped.run_for(0.4);
  ASSERT_GT(stopped.told(), 0) << stopped.log;
  for (const int sent : {SIGSTOP, SIGCONT}) {
    kill(stopped.told(), sent);
    EXPECT_TRUE(test::comes_to(stopped.told(), sent == SIGSTOP ? "T" : "SR"));
  }
  usleep(100'000);
  EXPECT_EQ(stopped.run(), "it went well") << "after all of its threads were interrupted";
  for (const char* when : {"when=step", "when=create"}) {
    Failing team("close_all", {}, {when});
    EXPECT_EQ(team.run(5), "it went well") << when;
    EXPECT_EQ(team.command(*team.a).linear.x(), 1);
  }
  const std::string said = refusal_of("closes_all_when_loaded.so", {{"isolate", std::string("process")}});
  EXPECT_TRUE(says(said,
                   "/closes_all_when_loaded.so ended its process: it has closed the socket to the simulation when it "
                   "was loaded"));
}

TEST(IsolatedController, MayWriteToAllFilesAndChangesNothing) {
  Failing team("write_to_all");
  EXPECT_EQ(team.run(0.25), "it went well");
  EXPECT_EQ(team.command(*team.a).linear.x(), 5) << "as it has said in this step";
}

TEST(IsolatedController, ThatIsNoLibraryIsRefusedInTheSameWords) {
  for (const auto& [library, message] : {std::pair{"no_symbol.so", "exports no `muro_controller`"},
                                         {"no_name.so", "its table has no name"},
                                         {"unresolved.so", "cannot be loaded: undefined symbol"},
                                         {"open_step.so", "would use functions of others in place of its own"}})
    EXPECT_TRUE(says(refusal_of(library, {{"isolate", std::string("process")}}), message));
  EXPECT_TRUE(says(refusal_of("crashes_when_loaded.so", {{"isolate", std::string("process")}}),
                   "/crashes_when_loaded.so crashed: SIGSEGV, invalid memory access"));
}

TEST(ControllerLibrary, WhoseCopyOfTheSimulatorComesBackLeavesOneSimulator) {
  Team team;
  team.control(folder + "fails.so", {{"arguments", Texts{"does=copy_itself"}}});
  team.build();
  const pid_t own = getpid();
  testing::internal::CaptureStderr();
  team.run_for(1);
  EXPECT_EQ(getpid(), own);
  int status = -1;
  EXPECT_GT(waitpid(-1, &status, 0), 0) << "the copy";
  EXPECT_EQ(status, 0);
  EXPECT_EQ(waitpid(-1, nullptr, WNOHANG), -1) << "and no other";
  EXPECT_TRUE(says(testing::internal::GetCapturedStderr(), "by fork(), came back from `step` and was ended; "));
}

TEST(ControllerLibrary, LeavesItsRobotAtRestWhereItFailsInTheSimulatorsProcess) {
  for (const char* how : {"throw", "throw_a_number"}) {
    Failing team(how, {{"isolate", std::string("none")}, {"on_failure", std::string("hold")}});
    EXPECT_EQ(team.run(), "it went well");
    EXPECT_EQ(team.command(*team.a).linear.x(), 0);
    EXPECT_EQ(team.command(*team.b).linear.x(), 1);
    EXPECT_TRUE(says(team.log, "robot `a`: `fails` threw an exception out of `step`"));
  }
  Failing team("throw", {{"isolate", std::string("none")}});
  EXPECT_TRUE(says(team.run(), "robot `a`: `fails` threw an exception out of `step`: a wheel is off"));
}

}  // namespace
}  // namespace muro::control
