// SPDX-License-Identifier: MIT
#include <gtest/gtest.h>

#include <iostream>

#include "tests/costs/budgets.hpp"
#include "tests/costs/count.hpp"
#include "tests/support/complaint.hpp"
#include "tests/support/files.hpp"

namespace muro::costs {
namespace {

/// Output of callgrind for the program and for a plugin with two functions, one of which calls the C library.
constexpr const char* written = R"(# callgrind format
version: 1
events: Ir

ob=/build/lib/muro/motion_point.so
fl=/src/point.cpp
fn=step(int)
0 1000
cob=/lib/libc.so.6
cfn=memcpy
calls=3 0
0 900
fn=turn<4, std::array<double, 3> >
0 500
ob=/lib/libc.so.6
fn=memcpy
0 900
ob=/build/tests/count_instructions
fn=run
0 100
calls=1 0
0 1500
)";

SceneBudget budget() {
  return {"points", "point.yaml", 0, 1, {}, {{"motion_point", {1500, {{"step(int)", 1000}}}}, {"core", {100, {}}}}};
}

TEST(Callgrind, CountsEachFunctionItselfInOurOwnObjects) {
  const test::ScratchFolder folder;
  const Costs costs =
      read_callgrind(folder.file("callgrind.out", written), "/build/lib/muro", "/build/tests/count_instructions");
  ASSERT_EQ(costs.size(), 2u);
  EXPECT_EQ(costs.at("motion_point").instructions, 1500u);
  EXPECT_EQ(costs.at("motion_point").functions.at("turn<4, std::array<double, 3> >"), 500u);
  EXPECT_EQ(costs.at("core").instructions, 100u);
}

TEST(Budgets, SayWhoHasGrownAndWhere) {
  Costs now = budget().costs;
  EXPECT_TRUE(grown(budget(), now, 0.02).empty());
  now["motion_point"] = {1575, {{"step(int)", 1075}, {"turn", 500}}};
  const std::vector<std::string> problems = grown(budget(), now, 0.02);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_SAYS(problems[0], "points: motion_point executes 1575 instructions, 5.0 % more than its budget of 1500");
  EXPECT_SAYS(problems[0], "1075 instead of 1000: step(int)");
}

TEST(Budgets, LetGrowthBelowTheAllowanceAndSavingsPass) {
  Costs now = budget().costs;
  now["motion_point"].instructions = 1529;
  now["core"].instructions = 50;
  EXPECT_TRUE(grown(budget(), now, 0.02).empty());
}

TEST(Budgets, TellOfAPluginThatIsNew) {
  Costs now = budget().costs;
  now["sensor_imu"] = {400, {}};
  const std::vector<std::string> problems = grown(budget(), now, 0.02);
  ASSERT_EQ(problems.size(), 1u);
  EXPECT_SAYS(problems[0], "points: sensor_imu executes 400 instructions and has no budget");
}

TEST(Budgets, AreReadAsTheyAreWritten) {
  const test::ScratchFolder folder;
  const std::string file = folder.file("budgets.txt", "# head\n");
  SceneBudget scene = budget();
  scene.overrides = {"a.b=1", "c=[2,3]"};
  write_budgets(file, {scene, budget()});
  EXPECT_TRUE(test::text_of(file).starts_with("# head\n"));
  const std::vector<SceneBudget> read = read_budgets(file);
  ASSERT_EQ(read.size(), 2u);
  EXPECT_EQ(read[0].overrides, scene.overrides);
  EXPECT_EQ(read[1].name, "points");
  EXPECT_TRUE(read[1].overrides.empty());
  EXPECT_EQ(read[0].costs.at("motion_point").functions.at("step(int)"), 1000u);
}

#if defined(MURO_COSTS_ARE_COMPARABLE)
TEST(SlowCosts, StayWithinTheirBudgets) {
  if (!__builtin_cpu_supports("avx2")) GTEST_SKIP() << "the budgets are those of AVX2";
  for (const auto& [budget, now] : count())
    for (const std::string& problem : grown(budget, now, 0.02)) ADD_FAILURE() << problem;
  if (HasFailure())
    std::cout << "Make it cheaper, or write the budgets anew (build/tests/record_costs), and say why in the commit.\n";
}
#endif

}  // namespace
}  // namespace muro::costs
