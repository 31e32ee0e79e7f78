// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <chrono>

#include "tests/support/bodies.hpp"

namespace muro {
namespace {

constexpr std::uint32_t coarse = 0, fine = 1;

/// A ball with two motions, `coarse` and `fine`.
struct Budgeted : test::Scene {
  const RobotView* ball;
  std::vector<std::string> log;

  explicit Budgeted(std::vector<std::string> rules, std::uint32_t start) {
    set_log([this](LogLevel, std::string_view text) { log.emplace_back(text); });
    ball = &add("ball", test::ball(1, 0.1, 0.5));
    use("motion.point", 1000, {{ball, ball->base(), 0}});
    use("motion.point", 1000, {{ball, ball->base(), 1}});
    set_levels(*ball, {"coarse", "fine"}, start);
    use("level.budget", 100, {{ball, ball->base()}}, {{"rules", std::move(rules)}});
    build();
  }
  std::uint32_t level() { return world().value(ball->base(), keys::motion_level); }
  /// Runs until the first measurement, of a quarter of a second of the machine's clock, is complete.
  void run_until_measured() {
    const auto end = std::chrono::steady_clock::now() + std::chrono::milliseconds(300);
    while (std::chrono::steady_clock::now() < end) run_for(0.1);
    run_for(0.1);
  }
};

TEST(LevelBudget, GivesUpDetailWhereTheRunIsSlow) {
  Budgeted s({"coarse when slower than 1e9"}, fine);
  EXPECT_EQ(s.level(), fine) << "nothing is measured yet";
  s.run_until_measured();
  EXPECT_EQ(s.level(), coarse);
}

TEST(LevelBudget, AddsDetailWhereTheRunIsFast) {
  Budgeted s({"fine when faster than 1e-9"}, coarse);
  s.run_until_measured();
  EXPECT_EQ(s.level(), fine);
}

TEST(LevelBudget, KnowsTheRulesOfLevelRulesToo) {
  Budgeted s({"fine at 0.05", "coarse when slower than 0"}, coarse);
  s.run_for(0.1);
  EXPECT_EQ(s.level(), fine);
}

TEST(LevelBudget, SaysThatItIsNotDeterministic) {
  EXPECT_EQ(test::plugins().algorithm("level.budget").description->capabilities & (deterministic | restorable), 0u);
  const Budgeted s({"fine when faster than 2"}, coarse);
  ASSERT_EQ(s.log.size(), 1u);
  EXPECT_NE(
      s.log[0].find(
          "(level.budget), robot `ball`: level.budget is not deterministic: it reads the machine's clock, so that no "
          "run is repeated exactly"),
      std::string::npos)
      << s.log[0];
}

}  // namespace
}  // namespace muro
