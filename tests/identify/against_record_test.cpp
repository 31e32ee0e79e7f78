// SPDX-License-Identifier: MIT
// `muro compare --against`: a scenario with the commands of a record.
#include <gtest/gtest.h>

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <sstream>

#include "tests/support/files.hpp"

namespace muro::host {
namespace {

test::CommandResult compare_against(const std::string& arguments) {
  return test::run_command("cd " MURO_TEST_SOURCE_DIR " && MURO_PLUGIN_PATH=" MURO_TEST_PLUGIN_DIR " " MURO_PROGRAM
                           " compare examples/motors/bench.yaml " +
                           arguments);
}

/// Returns the cells of the column `mean_error`.
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

/// Returns a record of a pendulum with an open coil that starts at 0.3 rad with `speed`: M1 without friction, small
/// steps.
std::string swinging(double speed, double duration, double gap_from = 1e9, double gap_to = 1e9, bool repeats = false) {
  std::string text = "# p_gain: 200\ntime,position,goal,supply_voltage,torque_enable\n";
  double q = 0.3, w = speed;
  constexpr double dt = 1e-5, load = 0.49 * 0.1 * 0.1, armature = 0.00181, length = 0.1;
  for (int k = 0; k * dt <= duration + 1e-9; ++k) {
    const double t = k * dt;
    if (k % 337 == 0 && !(t > gap_from && t < gap_to)) {
      const std::string line = fmt::format("{:.6f},{:.7f},1.5,7.4,0\n", t, q);
      text += line + (repeats && k == 337 * 40 ? line : "");
    }
    const double torque = -9.81 * 0.49 * length * std::sin(q), friction = 0.0128 + 0.0037 * std::abs(w);
    const double momentum = (load + armature) * w + torque * dt;
    w = (momentum > 0 ? std::max(0.0, momentum - friction * dt) : std::min(0.0, momentum + friction * dt)) /
        (load + armature);
    q += w * dt;
  }
  return text;
}

const char* const m1 = " --set robots.bench.motor.friction_model=m1";

TEST(CompareAgainst, AJointThatMovesAtTheStartGoesOn) {
  const test::ScratchFolder folder;
  const std::string record = folder.file("r.csv", swinging(4, 1));
  std::istringstream motions(MURO_TEST_MOTIONS);
  for (std::string motion; motions >> motion;) {
    const auto r = compare_against("--against " + record + " --csv " + folder.path("t.csv") + m1 +
                                   " --set robots.bench.motion.use=motion." + motion);
    ASSERT_EQ(r.exit_code, 0) << r.output;
    const std::vector<double> errors = mean_errors(test::text_of(folder.path("t.csv")));
    ASSERT_EQ(errors.size(), 1u);
    EXPECT_LT(errors.front(), 0.004) << motion << ": at rest it would be 0.3 rad";
    EXPECT_NE(r.output.find("at 0 s the joint starts with"), std::string::npos) << r.output;
  }
}

TEST(CompareAgainst, GapsAreToldAndNotBridged) {
  const test::ScratchFolder folder;
  const std::string record = folder.file("r.csv", swinging(4, 2, 0.4, 1.1, true));
  const auto r = compare_against("--against " + record + " --csv " + folder.path("t.csv") + m1);
  ASSERT_EQ(r.exit_code, 0) << r.output;
  EXPECT_NE(r.output.find("nothing is recorded from 0.3977 to 1.102 s; behind each gap the joint starts anew"),
            std::string::npos)
      << r.output;
  EXPECT_NE(r.output.find("1 samples at the time of the one before are left out"), std::string::npos) << r.output;
  const std::vector<double> errors = mean_errors(test::text_of(folder.path("t.csv")));
  ASSERT_EQ(errors.size(), 1u);
  EXPECT_LT(errors.front(), 0.006);
}

TEST(CompareAgainst, PositionsAreThoseOfTheTimesOfTheSamples) {
  // samples every 3.37 ms, steps of 10 ms: the position of a step would be 0.02 rad off at 4 rad/s
  const test::ScratchFolder folder;
  const std::string record = folder.file("r.csv", swinging(4, 0.3));
  const auto r = compare_against("--against " + record + " --csv " + folder.path("t.csv") + m1 +
                                 " --set robots.bench.motion.rate=100");
  ASSERT_EQ(r.exit_code, 0) << r.output;
  EXPECT_LT(mean_errors(test::text_of(folder.path("t.csv"))).front(), 0.01);
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
      {"--against none.csv", "none.csv cannot be read: No such file or directory"},
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
