// SPDX-License-Identifier: MIT
// Every description in every motion by forces: it loads, stands or falls as expected, and stays finite.
#include <gtest/gtest.h>

#include <set>

#include "tests/robots/expectations.hpp"

namespace muro::robots {
namespace {

constexpr const char* folders[] = {MURO_TEST_SOURCE_DIR "/tests/robots", MURO_TEST_SOURCE_DIR "/examples/models"};
constexpr double put_down_from = 0.05, leg_of_meshes = 0.1;  // m; see trial.cpp and meshes.urdf

class EveryRobot : public ::testing::TestWithParam<std::string> {
 protected:
  void SetUp() override {
    robot_ = robot_of(GetParam());
    expectation_ = expectation_of(robot_);
  }

  void hold(Check check, const Variant& v, double seen) const {
    EXPECT_LE(seen, bound_of(check, v.name, robot_).max) << name_of(check);
  }

  /// Checks that apply with any drive.
  void check_always(const Variant& v, const Observations& seen) const {
    EXPECT_LT(seen.norm_error, 1e-9);
    hold(Check::ground, v, -seen.lowest);
    hold(Check::impact, v, -seen.deepest);
    SCOPED_TRACE(seen.violating_joint);
    hold(Check::limits, v, seen.limit_violation);
    hold(Check::mimic, v, seen.mimic_error);
  }

  void check_driven(const Variant& v, const Observations& seen, bool fixed) const {
    double speed = 0;
    for (const JointObservation& j : seen.joints) {
      if (std::count(expectation_.without_effort.begin(), expectation_.without_effort.end(), j.name) > 0) {
        if (v.name != "simplified") {  // drives of motion.simplified have no effort limits by default
          EXPECT_GT(std::abs(j.moved), 0.5) << j.name << ", whose drive has no effort";
        }
        continue;
      }
      SCOPED_TRACE(j.name);
      if (!j.follows) hold(Check::hold, v, std::abs(j.moved));
      speed = std::max(speed, std::abs(j.speed));
    }
    if (fixed) {
      EXPECT_EQ(seen.fall, 0);
      EXPECT_EQ(seen.tilt, 0);
    } else {
      check_end(v, seen);
    }
    const bool rests = expectation_.end == End::stands || expectation_.end == End::topples;
    if (rests || fixed) hold(Check::rest, v, std::max(speed, seen.speed));
  }

  /// Checks the final state of a robot with a free base.
  void check_end(const Variant& v, const Observations& seen) const {
    switch (expectation_.end) {
      case End::stands:
        hold(Check::tilt, v, seen.tilt);
        hold(Check::height, v, std::abs(seen.fall - put_down_from - (sinks(v) ? leg_of_meshes : 0)));
        break;
      case End::topples:
        EXPECT_GT(seen.tilt, 0.5) << "it falls over";
        break;
      case End::falls:
        EXPECT_NEAR(seen.fall, 0.5 * 9.81 * 2 * 2, 0.02) << "g t^2 / 2";
        break;
      case End::balances:
        break;
    }
  }

  bool sinks(const Variant& v) const {
    return expectation_.on_meshes && (features_of(v.motion) & (feature_convex_meshes | feature_concave_meshes)) == 0;
  }

  Observations check(const Variant& v, bool fixed, bool passive) const {
    SCOPED_TRACE(v.name + (fixed ? ", fixed" : ", free") + (passive ? ", passive" : ", driven"));
    const Observations seen = run({GetParam(), v.motion, fixed, passive, 2, v.more});
    const std::string_view refusal = refusal_of(v.name, robot_, passive);
    EXPECT_EQ(seen.failure, "");
    if (!refusal.empty())
      EXPECT_NE(seen.refused.find(refusal), std::string::npos) << "refused with: " << seen.refused;
    else
      EXPECT_EQ(seen.refused, "");
    if (!refusal.empty() || !seen.refused.empty() || !seen.failure.empty()) return seen;
    check_always(v, seen);
    if (passive)
      hold(Check::energy, v, std::max(seen.energy_gain, seen.late_energy_gain) / seen.energy_scale);
    else
      check_driven(v, seen, fixed);
    return seen;
  }

  std::vector<Variant> tried() const {
    std::vector<Variant> some = variants();
    std::erase_if(some, [&](const Variant& v) { return expectation_.long_chain && v.name == "ode_quick"; });
    return some;
  }

  std::string robot_;
  Expectation expectation_;
};

TEST_P(EveryRobot, WithItsBaseFreeStandsOrFallsAsItShouldInEveryMotion) {
  double lowest = 1e9, highest = -1e9;
  for (const Variant& v : tried()) {
    const double height = check(v, false, false).height;
    check(v, false, true);
    if (!bound_of(Check::height, v.name, robot_).why.empty() || sinks(v)) continue;
    lowest = std::min(lowest, height);
    highest = std::max(highest, height);
  }
  if (expectation_.end == End::stands) {
    EXPECT_LT(highest - lowest, 5e-3) << "the height of its base depends on the motion";
  }
}

TEST_P(EveryRobot, WithItsBaseFixedHangsAndHoldsInEveryMotion) {
  for (const Variant& v : tried())
    for (const bool passive : {false, true}) check(v, true, passive);
}

std::vector<std::string> all_files() {
  std::vector<std::string> files;
  for (const char* folder : folders)
    for (const std::string& file : descriptions_below(folder)) files.push_back(file);
  return files;
}

INSTANTIATE_TEST_SUITE_P(Descriptions, EveryRobot, ::testing::ValuesIn(all_files()),
                         [](const auto& test) { return robot_of(test.param); });

TEST(QuadrupedA1, StandsWhereItIsPutDownGentlyInEveryMotion) {
  const std::string file = std::string(folders[1]) + "/quadruped_a1.urdf";
  for (const Variant& v : variants()) {
    const Observations seen = run({.file = file, .motion = v.motion, .more = v.more, .clearance = 0});
    EXPECT_EQ(seen.refused + seen.failure, "") << v.name;
    if (v.name == "ode_quick") continue;  // see expectations.cpp
    EXPECT_LT(seen.tilt, 5e-3) << v.name;
    EXPECT_NEAR(seen.fall, 0, 2e-3) << v.name;
  }
}

TEST(Descriptions, HaveNamesOfTheirOwn) {
  std::set<std::string> names;
  for (const std::string& file : all_files()) names.insert(robot_of(file));
  EXPECT_EQ(names.size(), all_files().size());
  EXPECT_GE(names.size(), 25u);
}

TEST(Motions, ThatForcesMoveAreFound) {
  const std::vector<std::string> found = motions();
  EXPECT_TRUE(std::count(found.begin(), found.end(), "motion.simplified"));
}

}  // namespace
}  // namespace muro::robots
