// SPDX-License-Identifier: MIT
#include "core/schedule/plan.hpp"

#include <gtest/gtest.h>

namespace muro {
namespace {

/// Runs of a plan on some machine, with the time that a run takes on one thread and on several, in ticks.
struct Runs {
  Plan::Tuner tuner = {};
  std::uint64_t one = 0, several = 0;
  int on_several = 0;

  /// Makes runs; returns the number of those on several threads.
  int make(int count) {
    on_several = 0;
    for (int i = 0; i < count; ++i) {
      const bool parallel = tuner.parallel();
      on_several += parallel;
      tuner.learn(parallel ? several : one);
    }
    return on_several;
  }
};

TEST(PlanTuner, UsesThreadsThatAreFasterNearlyAlways) {
  Runs runs{.one = 16'000, .several = 9'000};
  runs.make(100);
  EXPECT_GT(runs.make(10'000), 9'850);
}

TEST(PlanTuner, UsesOneThreadNearlyAlwaysWhereThatIsFaster) {
  Runs runs{.one = 5'000, .several = 6'000};
  runs.make(100);
  EXPECT_LT(runs.make(10'000), 150);
}

TEST(PlanTuner, KeepsSeveralThreadsWhileWorkGrows) {
  Runs runs{.one = 16'000, .several = 9'000};
  runs.make(5'000);
  for (int more = 0; more < 40; ++more) {  // in the end several threads take twice as long as one thread took at first
    runs.one += 1'000, runs.several += 600;
    EXPECT_GT(runs.make(1'000), 900) << runs.one;
  }
}

TEST(PlanTuner, KeepsSeveralThreadsWhenWorkDoublesAtOnce) {
  Runs runs{.one = 16'000, .several = 9'000};
  runs.make(300);
  runs.one *= 2, runs.several *= 2;
  EXPECT_GT(runs.make(1'000), 950);
}

TEST(PlanTuner, TakesSeveralThreadsSoonWhenOneHasMoreToDo) {
  Runs runs{.one = 5'000, .several = 6'000};
  runs.make(30'000);
  runs.one = 50'000, runs.several = 27'000;
  runs.make(100);
  EXPECT_GT(runs.make(1'000), 950);
}

TEST(PlanTuner, ReturnsToOneThreadWhenWorkShrinks) {
  Runs runs{.one = 16'000, .several = 9'000};
  runs.make(5'000);
  runs.one = 2'000, runs.several = 3'000;
  runs.make(5'000);  // until the next trial
  EXPECT_LT(runs.make(10'000), 150);
}

TEST(PlanTuner, BacksOffFromThreadsThatAreSlowExceptInTrials) {
  // A machine with more work than cores: it suspends a worker after some milliseconds, not at once.
  Runs runs{.one = 16'000, .several = 9'000};
  int slow = 0;
  for (int i = 0, in_a_row = 0; i < 50'000; ++i) {
    in_a_row = runs.tuner.parallel() ? in_a_row + 1 : 0;
    const bool suspended = in_a_row > 20;
    slow += suspended;
    runs.tuner.learn(!runs.tuner.parallel() ? 16'000 : suspended ? 100'000 : 9'000);
  }
  EXPECT_LT(slow, 2'000);
}

TEST(PlanTuner, IsNotDecidedByOneOutlier) {
  Runs runs{.one = 16'000, .several = 9'000};
  for (const int before : {10, 20, 500}) {  // during a trial, soon after it, later
    runs.make(before);
    runs.tuner.learn(50'000'000);  // 3000 times as long
    EXPECT_GT(runs.make(1'000), 950) << before;
  }
}

}  // namespace
}  // namespace muro
