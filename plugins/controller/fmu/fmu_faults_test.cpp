// SPDX-License-Identifier: MIT
// Messages for users when an FMU or its part of a scenario is wrong, and repair of steps that fail.
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

#include <cmath>

#include "core/external/input_log.hpp"
#include "fmu_testing.hpp"
#include "tests/support/processes.hpp"

namespace muro::fmu {
namespace {

constexpr Key<double> decay{"test.decay", "1", "what `decay` says"};
constexpr Key<std::int32_t> count{"test.count", "1", "what `count` says"};

const std::string variable_steps = R"(canHandleVariableCommunicationStepSize="true" )";

/// Same numbers as in model.h.
enum Fault {
  error = 1,
  fatal,
  end,
  crash,
  pending,
  event,
  early,
  nan,
  grows,
  at_start,
  warns,
  no_last_time,
  hangs,
  exits,
  chats,
  forks,
  closes,
  copies
};

class FmuFault : public ::testing::TestWithParam<int> {
 protected:
  int version() const { return GetParam(); }
  std::string prefix() const { return "fmi" + std::to_string(version()); }
  const std::string& able() const { return version() == 2 ? able_2 : able_3; }

  /// Runs an FMU with these flags and values for 1 s. Returns the error, or "no complaint".
  std::string run(const std::string& flags, Texts values, const std::string& library = "") {
    const test::ScratchFolder scratch;
    write_fmu(scratch.path("x.fmu"), version(), flags, library);
    Bench bench;
    const double& d = bench.sink(decay);
    const std::int32_t& n = bench.sink(count);
    bench.control(scratch.path("x.fmu"), version(),
                  Texts{"decay=test.decay", "count=test.count", "speed=command.twist[vx]"}, std::move(values));
    bench.build();
    const std::string how = failure(bench, 1.05);
    decay_ = d, count_ = n, said_ = bench.said;
    return how;
  }
  static std::string fault(Fault f) { return "fault=" + std::to_string(f); }

  double decay_ = 0;
  int count_ = 0;
  std::string said_;
};

TEST_P(FmuFault, EndsTheRunWithTheWordsOfTheFmu) {
  EXPECT_SAYS(run(able(), {fault(error), "label=my own FMU", "fault_time=0.25"}),
              "robot `a`: x.fmu: `" + prefix() + "DoStep` fails with " + prefix() +
                  "Error: it is all wrong at t = 0.2, label 'my own FMU'");
  EXPECT_SAYS(run(able(), {fault(fatal)}), "`" + prefix() + "DoStep` fails with " + prefix() + "Fatal: it is broken");
  EXPECT_SAYS(run(able(), {fault(nan)}),
              "robot `a`: x.fmu: variable `speed` is not a number; outputs must be finite numbers");
  EXPECT_SAYS(run(able(), {fault(end)}), std::string("the FMU asks to end the simulation (") +
                                             (version() == 2 ? "fmi2Terminated" : "terminateSimulation") +
                                             ") between t = 0.4 s and 0.5 s");
  EXPECT_SAYS(run(able(), {fault(end), "fault_time=0.25"}), " between t = 0.2 s and 0.3 s") << "0.3 is 3 * 0.1";
}

TEST_P(FmuFault, RepeatsDiscardedStepsWithSmallerOnes) {
  ASSERT_EQ(run(able(), {"largest_step=0.03"}), "no complaint");
  EXPECT_NEAR(decay_, std::exp(-1), 1e-12);
  EXPECT_EQ(count_, 40) << "parts: four in each step";
  if (version() == 3) return;
  ASSERT_EQ(run(able(), {"largest_step=0.03", fault(no_last_time)}), "no complaint");
  EXPECT_NEAR(decay_, std::exp(-1), 1e-12);
}

TEST_P(FmuFault, NamesTheFlagThatARepetitionNeeds) {
  EXPECT_SAYS(run("", {"largest_step=0.03"}),
              "the FMU discards the communication step between t = 0 s and 0.1 s, and the FMU lacks the flag "
              "canHandleVariableCommunicationStepSize");
  const std::string without_state = run(variable_steps, {"largest_step=0.03"});
  if (version() == 2)
    EXPECT_SAYS(without_state, "lacks the flag canGetAndSetFMUstate");
  else
    EXPECT_EQ(without_state, "no complaint") << "a discarded step leaves the state as it was";
  EXPECT_SAYS(run(able(), {"largest_step=0"}), "and all smaller ones");
}

TEST_P(FmuFault, AtTheStartIsToldBeforeTheRun) {
  const test::ScratchFolder scratch;
  write_fmu(scratch.path("x.fmu"), version(), able());
  Bench bench;
  bench.control(scratch.path("x.fmu"), version(), Texts{}, {fault(at_start)});
  EXPECT_SAYS(refusal(bench), "robot `a`: x.fmu: `" + prefix() + "ExitInitializationMode` fails with " + prefix() +
                                  "Error: I do not like this start");
}

TEST_P(FmuFault, WarningsGoToTheLogOfTheRun) {
  ASSERT_EQ(run("", {fault(warns), "label=x"}), "no complaint");
  EXPECT_SAYS(said_, "robot `a`: FMU: beware at t = 0.1, label 'x'");
  ASSERT_EQ(run("", {fault(chats)}), "no complaint");
  EXPECT_EQ(said_.find("all is well"), std::string::npos) << "only what matters";
}

TEST_P(FmuFault, AllItsWordsAreLoggedOnRequestWithinBounds) {
  const test::ScratchFolder scratch;
  write_fmu(scratch.path("x.fmu"), version(), "");
  Bench bench;
  bench.control(scratch.path("x.fmu"), version(), Settings{{"logging", true}}, {fault(chats)});
  bench.build();
  bench.run_for(9.95);
  EXPECT_SAYS(bench.said, "robot `a`: FMU: all is well at t = 9.9, label ''");
  bench.run_for(20);
  EXPECT_EQ(bench.said.find("all is well at t = 10.1"), std::string::npos);
  const std::string last = "robot `a`: further messages of its FMU are left out\n";
  EXPECT_SAYS(bench.said, last);
  EXPECT_EQ(bench.said.find(last), bench.said.rfind(last)) << "said once";
}

TEST_P(FmuFault, OfItsStepSizeIsAWarningWhereItOnlyHasAPreference) {
  const test::ScratchFolder scratch;
  const std::string path = scratch.path("x.fmu");
  std::string xml = description(version(), "");
  xml.insert(xml.find("<ModelVariables>"), "<DefaultExperiment stepSize=\"0.03\"/>");
  write_archive(path, {{"modelDescription.xml", xml},
                       {"binaries/" + platform_of[version()] + "/model.so",
                        test::text_of(parts + "model" + std::to_string(version()) + ".so")}});
  Bench bench;
  bench.control(path, version(), Texts{"speed=command.twist[vx]"});
  bench.build();
  bench.run_for(0.2);
  EXPECT_SAYS(bench.said,
              "x.fmu: it prefers communication steps of 0.03 s (stepSize) and lacks the flag "
              "canHandleVariableCommunicationStepSize, and the period is 0.1 s");
}

TEST_P(FmuFault, LeavesNoFilesBehind) {
  const test::ScratchFolder scratch;
  std::filesystem::create_directory(scratch.path("tmp"));
  write_fmu(scratch.path("x.fmu"), version(), able());
  const char* const before = std::getenv("TMPDIR");
  const std::string kept = before ? before : "";
  setenv("TMPDIR", scratch.path("tmp").c_str(), 1);
  for (const bool fails : {false, true}) {
    Bench bench;
    bench.control(scratch.path("x.fmu"), version(), Texts{fails ? "nothing=pose[x]" : "speed=command.twist[vx]"});
    if (fails)
      EXPECT_SAYS(refusal(bench), "the FMU has no variable `nothing`");
    else
      bench.build();
    EXPECT_FALSE(std::filesystem::is_empty(scratch.path("tmp")) && !fails);
  }
  EXPECT_TRUE(std::filesystem::is_empty(scratch.path("tmp")));
  before ? setenv("TMPDIR", kept.c_str(), 1) : unsetenv("TMPDIR");
}

TEST_P(FmuFault, StatesThatGrowBeyondWhatWasSetAsideEndTheRun) {
  EXPECT_SAYS(run(able(), {fault(grows)}), "x.fmu: its state has grown to ");
}

TEST_P(FmuFault, MoreThanOneInstanceOfSomeNeedsProcesses) {
  const test::ScratchFolder scratch;
  const std::string library = "only_one" + std::to_string(version());
  const std::string plain = scratch.path("plain.fmu"), path = scratch.path("x.fmu");
  write_fmu(plain, version(), "", library);
  Bench lie(2);
  lie.control(plain, version(), Texts{});
  const std::string said = refusal(lie);
  EXPECT_SAYS(said, "robot `b`: plain.fmu: `");
  EXPECT_SAYS(said, "makes no instance: there is one already");

  write_fmu(path, version(), R"(canBeInstantiatedOnlyOncePerProcess="true")", library);
  const Settings drive{{"inputs", Texts{"u=pose[0]"}}, {"outputs", Texts{"speed=command.twist[0]"}}};
  Bench one;
  one.control(path, version(), drive);
  Bench team(2);
  team.control(path, version(), drive);
  one.build();
  team.build();
  one.run_for(1), team.run_for(1);
  const double rest = std::pow(1 - 0.1 * 2, 10);
  EXPECT_NEAR(one.pose(*one.a).position.x(), 1 - rest, 1e-9) << "in this process";
  EXPECT_NEAR(team.pose(*team.b).position.x(), 1 + 3 * rest, 1e-9) << "in others";
}

TEST_P(FmuFault, InAProcessOfItsOwnEndsTheRunAlone) {
  const test::ScratchFolder scratch;
  write_fmu(scratch.path("x.fmu"), version(), able());
  const auto end_with = [&](Fault f) {
    Bench bench;
    bench.control(scratch.path("x.fmu"), version(), Settings{{"isolate", std::string("process")}, {"timeout", 0.3}},
                  {fault(f), "label=far away"});
    bench.build();
    return failure(bench, 1);
  };
  EXPECT_SAYS(end_with(error), "robot `a`: x.fmu: `" + prefix() + "DoStep` fails with " + prefix() +
                                   "Error: it is all wrong at t = 0.4, label 'far away'");
  EXPECT_SAYS(end_with(hangs), "robot `a`: x.fmu: it did not return within `timeout` of 0.3");
  EXPECT_SAYS(end_with(exits), "robot `a`: x.fmu: its process has ended with exit code 3");
#if !defined(__SANITIZE_ADDRESS__)
  EXPECT_SAYS(end_with(crash),
              "robot `a`: x.fmu: it has crashed in `" + prefix() + "DoStep`: its process was killed by SIGSEGV");
#endif
}

TEST_P(FmuFault, InAProcessOfItsOwnThatHasClosedItsSocketIsNamedAtOnce) {
  const test::ScratchFolder scratch;
  write_fmu(scratch.path("x.fmu"), version(), able());
  Bench bench;
  bench.is_isolated = true;
  bench.control(scratch.path("x.fmu"), version(), Texts{"speed=command.twist[vx]"}, {fault(closes)});
  bench.build();
  const std::string said = failure(bench, 1);
  EXPECT_SAYS(said, "robot `a`: x.fmu: its process has closed its socket to the simulation");
  EXPECT_SAYS(said, "t = 0.5");
}

TEST_P(FmuFault, InAProcessOfItsOwnTakesProcessesAlong) {
  const test::ScratchFolder scratch;
  write_fmu(scratch.path("x.fmu"), version(), able());
  pid_t other = 0;
  {
    Bench bench;
    const std::int32_t& n = bench.sink(count);
    bench.is_isolated = true;
    bench.control(scratch.path("x.fmu"), version(), Texts{"count=test.count"}, {fault(forks)});
    bench.build();
    EXPECT_EQ(failure(bench, 1), "no complaint");
    other = n;
    EXPECT_TRUE(test::is_running(other));
  }
  EXPECT_TRUE(test::ends_soon(other));
}

TEST_P(FmuFault, OfACopyThatComesBackLeavesOneSimulator) {
  const pid_t own = getpid();
  ::testing::internal::CaptureStderr();
  EXPECT_EQ(run(able(), {fault(copies)}), "no complaint");
  EXPECT_EQ(getpid(), own);
  EXPECT_GT(waitpid(-1, nullptr, 0), 0) << "a copy";
  while (waitpid(-1, nullptr, WNOHANG) > 0) continue;
  EXPECT_SAYS(::testing::internal::GetCapturedStderr(), "by fork(), came back from `fmi");
}

TEST_P(FmuFault, ByTheClockOrAKillMakesTheRunNotRepeatable) {
  const test::ScratchFolder scratch;
  write_fmu(scratch.path("x.fmu"), version(), able());
  const auto reasons_of = [&](Fault f, bool is_killed) {
    Bench bench;
    bench.control(scratch.path("x.fmu"), version(), Settings{{"isolate", std::string("process")}, {"timeout", 0.3}},
                  {fault(f)});
    bench.build();
    const std::vector<pid_t> children = test::child_processes();
    EXPECT_EQ(children.size(), 1u);
    if (is_killed) kill(children.at(0), SIGKILL);
    EXPECT_NE(failure(bench, 1), "no complaint");
    return bench.inputs().reasons();
  };
  const std::string fmu = "robot `a`: x.fmu: ";
  EXPECT_EQ(reasons_of(exits, true),
            Texts{fmu + "its process was killed by SIGKILL, from outside or by the system for want of memory"});
  EXPECT_EQ(reasons_of(hangs, false), Texts{fmu + "it did not return within `timeout` of 0.3 s"});
  EXPECT_EQ(reasons_of(exits, false), Texts{});
}

#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
TEST_P(FmuFault, FunctionsOfTheLibraryItselfComeFirst) {
  EXPECT_EQ(run(able(), {}, "open_step" + std::to_string(version())), "no complaint");
}
#endif

TEST_P(FmuFault, OfLibrariesIsNamed) {
  const test::ScratchFolder scratch;
  const std::string path = scratch.path("x.fmu"), folder = "binaries/" + platform_of[version()] + "/";
  const std::string library = test::text_of(parts + "model" + std::to_string(version()) + ".so");
  const auto refusal_of = [&](const std::vector<Entry>& entries) {
    write_archive(path, entries);
    Bench bench;
    bench.control(path, version(), Texts{});
    return refusal(bench);
  };
  const Entry xml{"modelDescription.xml", description(version(), able())};
  EXPECT_SAYS(refusal_of({xml, {"binaries/win64/model.dll", ""}, {"binaries/darwin64/model.dylib", ""}}),
              "x.fmu holds no library for this machine, " + folder +
                  "model.so; it holds folders for: `darwin64`, `win64`. Export it for Linux on this processor");
  EXPECT_SAYS(refusal_of({xml, {folder + "other.so", library}}),
              "x.fmu holds no " + folder +
                  "model.so, where modelIdentifier says that its library is; that folder holds `other.so`");
  EXPECT_SAYS(refusal_of({xml, {folder + "model.so", library.substr(0, 5000)}}),
              "its library model.so cannot be loaded: the file has 5000 bytes and should have at least ");
  EXPECT_SAYS(refusal_of({xml, {folder + "model.so", "no library"}}), "its library cannot be loaded: model.so: ");
  EXPECT_SAYS(refusal_of({xml, {folder + "model.so", test::text_of(parts + "wants_python.so")}}),
              "undefined symbol: _Py_NoneStruct; it takes Python from the program that loads it: start muro with "
              "LD_PRELOAD=");
  EXPECT_SAYS(refusal_of({xml, {folder + "model.so", test::text_of(parts + "empty.so")}}),
              "its library has no function `" + prefix() + "GetVersion`");
  Entry other = xml;
  other.bytes.replace(other.bytes.find("{the-token}"), 11, "{another-1}");
  EXPECT_SAYS(refusal_of({other, {folder + "model.so", library}}), "makes no instance: the ");
}

TEST_P(FmuFault, OfAScenarioIsNamed) {
  const test::ScratchFolder scratch;
  const std::string path = scratch.path("x.fmu");
  write_fmu(path, version(), able());
  const auto refusal_with = [&](const Settings& settings, const Texts& values = {}) {
    Bench bench;
    bench.control(path, version(), settings, values);
    return refusal(bench);
  };
  const auto inputs = [](const std::string& text) { return Settings{{"inputs", Texts{text}}}; };
  const auto outputs = [](const std::string& text) { return Settings{{"outputs", Texts{text}}}; };
  EXPECT_SAYS(refusal_with(inputs("u=pose")),
              "variable `u` has 1 number, and what it is connected to has 7: "
              "`a/body:pose`; choose some by [0], [vx] or [0..2] behind its name");
  EXPECT_SAYS(refusal_with(inputs("u=pose[vx]")),
              "`vx` is no scalar of `a/body:pose`; they are numbered from 0, as in "
              "[0] or [0..2], or called `x`, `y`, `z`, `qx`, `qy`, `qz`, `qw`");
  EXPECT_SAYS(refusal_with(inputs("u=pose[7]")), "`a/body:pose` has 7 scalars, [0] to [6]; number 7 is not among them");
  EXPECT_SAYS(refusal_with(inputs("angle=pose[x]")),
              "variable `angle` cannot be connected to `a/body:pose`: its unit is `deg`, and that is in `m`");
  EXPECT_SAYS(refusal_with(inputs("u=pse[x]")), "no object of robot `a` has a property `pse` (did you mean `pose`?)");
  EXPECT_SAYS(refusal_with(inputs("u=body:psoe[x]")),
              "object `a/body` has no property `psoe` (did you mean `pose`?); it has `");
  EXPECT_SAYS(refusal_with(inputs("u=arm:pose[x]")), "robot `a` has no object `arm`; it has `body`");
  EXPECT_SAYS(refusal_with(inputs("anlge=pose[x]")),
              "`inputs`: `anlge=pose[x]`: the FMU has no variable `anlge` (did "
              "you mean `angle`?); what may stand here: ");
  EXPECT_SAYS(refusal_with(inputs("speed=pose[x]")), "`speed` is not an input or a tunable parameter");
  EXPECT_SAYS(refusal_with(inputs("u")), "`inputs`: `u` must be \"variable=object:property\"");
  EXPECT_SAYS(refusal_with(outputs("u=command.twist[0]")), "`u` is not an output");
  EXPECT_SAYS(refusal_with(outputs("speed=command.twist[wz]")), "its unit is `m/s`, and that is in `rad/s`");
  EXPECT_SAYS(refusal_with({}, {"kk=1"}), "the FMU has no variable `kk`");
  EXPECT_SAYS(refusal_with({}, {"speed=1"}), "`speed` is not a parameter, an input, or a variable with `initial`");
  EXPECT_SAYS(refusal_with({}, {"k=1,5"}), "value `1,5` of `k` is no number; the decimal sign is a point");
  EXPECT_SAYS(refusal_with({}, {"k=1 2"}), "value `1 2` of `k` has 2 numbers, and needs 1");
  EXPECT_SAYS(refusal_with({}, {"fault=0.5"}), "value `0.5` of `fault` does not fit into its type, ");
  EXPECT_SAYS(refusal_with({}, {"k=1", "k=2"}), "`k` is given twice");
  Bench open;
  open.use("controller.fmu", 10, open.all_robots(), Settings{{"fmu", path}});
  EXPECT_SAYS(refusal(open), "robot `a`: x.fmu: its inputs `u`, `angle`, ");
  Bench idle;
  idle.control(path, version(), Texts{});
  idle.build();
  EXPECT_SAYS(idle.said, "x.fmu: none of its outputs is connected to anything");
}

TEST_P(FmuFault, ThatCrashesIsNamedWithItsFunction) {
  const test::ScratchFolder scratch;
  write_fmu(scratch.path("x.fmu"), version(), able());
  std::string values = "\"fault=4\"";
  for (const std::string& text : closed_inputs(version())) values += ", \"" + text + "\"";
  scratch.file("r.urdf", "<robot name=\"r\"><link name=\"body\"/></robot>");
  scratch.file("s.yaml",
               "robots:\n  r:\n    model: r.urdf\n    motion: {use: motion.point}\n    control: {use: "
               "controller.fmu, rate: 10, fmu: x.fmu, outputs: [\"speed=command.twist[vx]\"], parameters: [" +
                   values + "]}\n");
  const test::CommandResult result = test::run_command(
      "TMPDIR=" + scratch.path("") + " MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " " MURO_PROGRAM " run " +
      scratch.path("s.yaml") + " --duration 2");
  EXPECT_NE(result.exit_code, 0);
  EXPECT_SAYS(result.output, "r.control (controller.fmu), robot `r`, crashed in `" + prefix() + "DoStep` of ");
  EXPECT_SAYS(result.output, "at t = 0.500000 s: SIGSEGV");
}

INSTANTIATE_TEST_SUITE_P(OfFmi, FmuFault, ::testing::Values(2, 3),
                         [](const auto& test) { return std::to_string(test.param); });

class FmuFaultOf2 : public FmuFault {};

TEST_P(FmuFaultOf2, StepsThatAreStillBeingDoneAreWaitedFor) {
  ASSERT_EQ(run(R"(canRunAsynchronuously="true")", {fault(pending)}), "no complaint");
  EXPECT_NEAR(decay_, std::exp(-1), 1e-12);
}

TEST_P(FmuFaultOf2, FunctionsThatFlagsPromiseAndVersionsAreChecked) {
  const auto refusal_of = [&](const std::string& library) {
    return test::complaint_of([&] { run(able(), {}, library); });
  };
  EXPECT_SAYS(refusal_of("no_state"),
              "its library has no function `fmi2GetFMUstate`, which the standard and its flags");
  EXPECT_SAYS(refusal_of("other_version"), "`fmi2GetVersion` of its library says `1.0`, and the model description is");
}

INSTANTIATE_TEST_SUITE_P(OfFmi, FmuFaultOf2, ::testing::Values(2));

class FmuFaultOf3 : public FmuFault {};

TEST_P(FmuFaultOf3, EarlyReturnsAreFollowedByTheRestOfTheStep) {
  ASSERT_EQ(run(able(), {fault(early), "fault_time=0.43"}), "no complaint");
  EXPECT_NEAR(decay_, std::exp(-1), 1e-12);
  EXPECT_EQ(count_, 10);
  EXPECT_EQ(said_, "");
  EXPECT_SAYS(
      run(R"(mightReturnEarlyFromDoStep="true")", {fault(early), "fault_time=0.43"}),
      "the FMU returns early from the communication step between t = 0.4 s and 0.5 s, and the FMU lacks the flag "
      "canHandleVariableCommunicationStepSize");
  EXPECT_SAYS(said_, "early without leave");
}

TEST_P(FmuFaultOf3, EventsThatItWasToldNotToHaveEndTheRun) {
  EXPECT_SAYS(
      run(able() + R"( hasEventMode="true")", {fault(event)}),
      "the FMU asks for event mode (eventHandlingNeeded) between t = 0.4 s and 0.5 s; it was told that there is none");
}

INSTANTIATE_TEST_SUITE_P(OfFmi, FmuFaultOf3, ::testing::Values(3));

}  // namespace
}  // namespace muro::fmu
