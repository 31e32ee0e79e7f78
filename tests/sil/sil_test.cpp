// SPDX-License-Identifier: MIT
// examples/sil: an external program drives a vehicle. It uses a scanner on a pseudo-terminal and a drive on TCP.
#include <gtest/gtest.h>

#include <cstdlib>
#include <nlohmann/json.hpp>

#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"
#include "tests/support/peer.hpp"

namespace muro {
namespace {

const std::string example = MURO_TEST_SOURCE_DIR "/examples/sil/";

/// Returns a port of this machine that is not in use.
std::string free_port() { return std::to_string(test::port_of(test::Peer(test::bound_to_tcp()).fd)); }

class AVehicleWithAPilotOutside : public testing::Test {
 protected:
  void SetUp() override {
    if (test::run_command("python3 -c pass").exit_code != 0) GTEST_SKIP() << "needs python3";
  }

  struct Run {
    test::CommandResult result;
    nlohmann::json report;
    std::string hash() const { return report.value("state_hash", "none"); }
    double distance() const { return report["robots"][0]["distance_m"]; }
  };

  /// `pilot`: command that runs pilot.py, or a substitute; empty: no pilot.
  Run run(const std::string& options, const std::string& pilot) {
    const std::string port = free_port(), laser = scratch_.path("laser"), report = scratch_.path("report.json");
    std::string command = "MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " " MURO_PROGRAM " run " + example +
                          "sil.yaml --duration " + duration_ + " --report " + report +
                          " --set robots.rover.scanner.stream.pty=" + laser +
                          " --set robots.rover.command.stream.tcp=" + port + " " + options;
    if (!pilot.empty())
      command += " & muro=$!; " + pilot + " " + example + "pilot.py --laser " + laser + " --drive 127.0.0.1:" + port +
                 " & pilot=$!; " + after_start_ + " wait $muro; code=$?; wait $pilot; exit $code";
    Run r{test::run_command(command), {}};
    r.report = nlohmann::json::parse(test::text_of(report), nullptr, false);
    return r;
  }

  test::ScratchFolder scratch_;
  std::string after_start_;     ///< command of the shell meanwhile
  std::string duration_ = "8";  ///< s
};

TEST_F(AVehicleWithAPilotOutside, EndsInTheSameStateWhateverThePilotsDelays) {
  const Run first = run("", "python3");
  ASSERT_EQ(first.result.exit_code, 0) << first.result.output;
  EXPECT_GT(first.distance(), 1.5) << "it drives";
  EXPECT_TRUE(first.report["external_inputs"]["not_repeatable"].empty()) << first.report["external_inputs"];
  EXPECT_GT(first.report["external_inputs"]["count"], 100);
  for (const char* delay : {"0.002", "0.006"}) {
    const Run again = run("--threads 2", std::string("env PILOT_DELAY=") + delay + " python3");
    EXPECT_EQ(again.hash(), first.hash()) << delay << again.result.output;
  }
}

TEST_F(AVehicleWithAPilotOutside, IsReplayedWithoutIt) {
  const std::string inputs = scratch_.path("inputs.csv");
  const Run recorded = run("--record " + inputs, "python3");
  ASSERT_EQ(recorded.result.exit_code, 0) << recorded.result.output;
  const Run replayed = run("--replay " + inputs, "");
  EXPECT_EQ(replayed.result.exit_code, 0) << replayed.result.output;
  EXPECT_SAYS(replayed.result.output, "the replay ended in the recorded state");
  EXPECT_EQ(replayed.hash(), recorded.hash());
  EXPECT_FALSE(std::filesystem::exists(scratch_.path("laser"))) << "a replay opens nothing";
}

TEST_F(AVehicleWithAPilotOutside, IsReplayedFromTheRecordingOfAReplayAsWell) {
  const std::string inputs = scratch_.path("inputs.csv"), again = scratch_.path("again.csv");
  duration_ = "2";
  const Run live = run("--record " + inputs, "python3");
  ASSERT_EQ(run("--replay " + inputs + " --record " + again, "").result.exit_code, 0);
  EXPECT_EQ(test::text_of(again), test::text_of(inputs));
  EXPECT_EQ(run("--replay " + again, "").hash(), live.hash());
}

TEST_F(AVehicleWithAPilotOutside, SaysWhenTheEndOfAReplayIsNotCompared) {
  const std::string inputs = scratch_.path("inputs.csv");
  duration_ = "2";
  ASSERT_EQ(run("--record " + inputs, "python3").result.exit_code, 0);
  const std::string replay = "--replay " + inputs;
  EXPECT_SAYS(run(replay, "").result.output, "ended in the recorded state");
  duration_ = "3";
  const std::string ended = "the recorded run ended at t = 2 s; this one ";
  EXPECT_SAYS(run(replay, "").result.output, ended + "has gone on, so their ends are not compared");
  duration_ = "1";
  EXPECT_SAYS(run(replay, "").result.output, ended + "ends earlier, so their ends are not compared");
  duration_ = "3";
  const Run other = run(replay + " --set robots.rover.command.rate=25", "");
  EXPECT_EQ(other.result.exit_code, 1);
  EXPECT_SAYS(other.result.output, "were not taken by anyone");
}

TEST_F(AVehicleWithAPilotOutside, IsComparedWithoutThePilotWhoIsNotWaitedFor) {
  const std::string laser = scratch_.path("laser");
  const test::CommandResult result =
      test::run_command("MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " " MURO_PROGRAM " compare " + example +
                        "sil.yaml --duration 1 --vary rover.motion=differential_drive,simplified" +
                        " --set robots.rover.scanner.stream.pty=" + laser);
  EXPECT_EQ(result.exit_code, 0) << result.output;
  EXPECT_EQ(result.output.find("serves on"), std::string::npos) << result.output;
}

TEST_F(AVehicleWithAPilotOutside, IsDrivenByTheSamePilotAtEveryLevel) {
  for (const char* motion : {"motion.point", "motion.bullet"}) {
    const Run r = run(std::string("--set robots.rover.motion.use=") + motion, "python3");
    ASSERT_EQ(r.result.exit_code, 0) << r.result.output;
    EXPECT_GT(r.distance(), 1.5) << motion;
  }
}

TEST_F(AVehicleWithAPilotOutside, StandsWhenThePilotIsKilledAndTheRunGoesOn) {
  after_start_ = "sleep 2; kill -9 $pilot;";
  duration_ = "40";
  const Run r = run("--set robots.rover.command.on_disconnect=stop", "env PILOT_DELAY=0.06 python3");
  ASSERT_EQ(r.result.exit_code, 0) << r.result.output;
  EXPECT_DOUBLE_EQ(r.report["simulated_s"], 40);
  EXPECT_LT(r.distance(), 4) << "in 40 s it would have driven farther";
}

TEST_F(AVehicleWithAPilotOutside, IsWaitedForInVainWhenThereIsNoPilot) {
  const Run r = run("--set robots.rover.scanner.stream.timeout=0.2", "");
  EXPECT_EQ(r.result.exit_code, 1);
  EXPECT_SAYS(r.result.output, "pilot");
  const Run on =
      run("--set robots.rover.scanner.stream.timeout=0.2 --set robots.rover.command.stream.timeout=0.2 --set "
          "robots.rover.scanner.stream.on_timeout=go_on --set robots.rover.command.stream.on_timeout=go_on",
          "");
  EXPECT_EQ(on.result.exit_code, 0) << on.result.output;
  EXPECT_FALSE(on.report["external_inputs"]["not_repeatable"].empty());
}

/// The first rover of the urban team alone. The only external inputs end the run or reset it.
struct ARecordedRun : testing::Test {
  /// `then`: next command of the shell.
  test::CommandResult run(const std::string& options, const std::string& then = "") const {
    return test::run_command("MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " " MURO_PROGRAM " run " MURO_TEST_SOURCE_DIR
                             "/examples/urban/urban.yaml --set robots.rovers.count=1 " +
                             options + then);
  }
  double distance(const std::string& options) const {
    const std::string report = scratch_.path("report.json");
    EXPECT_EQ(run(options + " --report " + report).exit_code, 0);
    return nlohmann::json::parse(test::text_of(report))["robots"][0]["distance_m"];
  }
  test::ScratchFolder scratch_;
};

TEST_F(ARecordedRun, ThatWasInterruptedIsReplayedUpToThere) {
  const std::string inputs = scratch_.path("inputs.csv"), again = scratch_.path("again.csv");
  const auto interrupted =
      run("--speed real --record " + inputs, " & muro=$!; while kill -0 $muro && ! test -s " + inputs +
                                                 ".part; do sleep 0.02; done; sleep 0.5; kill -TERM $muro; wait $muro");
  EXPECT_EQ(interrupted.exit_code, 130) << interrupted.output;
  const std::string recorded = test::text_of(inputs);
  ASSERT_NE(recorded.find(",simulation,5,0,\nend,"), std::string::npos) << recorded;
  const auto replayed = run("--replay " + inputs + " --record " + again);
  EXPECT_EQ(replayed.exit_code, 0);
  EXPECT_SAYS(replayed.output, "the replay ended in the recorded state");
  EXPECT_EQ(test::text_of(again), recorded);
}

TEST_F(ARecordedRun, WithAResetCountsTheDistanceBeforeAndBehindIt) {
  const std::string inputs = scratch_.path("inputs.csv");
  run("--duration 1 --record " + inputs);
  const std::string recorded = test::text_of(inputs);
  const std::string with_reset =
      scratch_.file("reset.csv", recorded.substr(0, recorded.find("end,")) + "0,2050000000,simulation,2,0,\n");
  EXPECT_NEAR(distance("--duration 4 --replay " + with_reset), distance("--duration 2.05") + distance("--duration 4"),
              1e-6);
}

}  // namespace
}  // namespace muro
