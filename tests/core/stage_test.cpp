// SPDX-License-Identifier: MIT
#include "core/schedule/stage.hpp"

#include <gtest/gtest.h>

#include <map>
#include <random>
#include <set>

namespace muro {
namespace {

using IndexSpace = Phase::IndexSpace;
using Scope = Phase::Scope;

TEST(BlockBounds, CoverAllRobotsAndBeginAtSimdLanes) {
  for (std::uint32_t count = 0; count < 3000; ++count) {
    const std::vector<std::uint32_t> bounds = block_bounds(count);
    ASSERT_EQ(bounds.front(), 0u);
    ASSERT_EQ(bounds.back(), count);
    for (std::size_t i = 1; i + 1 < bounds.size(); ++i) {
      ASSERT_EQ(bounds[i] % 8, 0u) << count;
      ASSERT_LT(bounds[i], bounds[i + 1]) << count;
      ASSERT_LE(bounds[i] - bounds[i - 1], 72u) << count;
    }
  }
}

TEST(BlockBounds, GiveTwoThreadsNearlyEqualHalves) {
  for (const std::uint32_t count : {50u, 100u, 200u, 500u, 1000u, 4000u}) {
    const std::vector<std::uint32_t> bounds = block_bounds(count);
    const std::size_t blocks = bounds.size() - 1;
    EXPECT_LE(bounds[blocks / 2], count / 2 + 8) << count;
    EXPECT_GE(bounds[blocks / 2], count / 2 - 8) << count;
  }
}

/// A team of `robots` whose robot r owns the slots 10 r to 10 r + 9; slots from 10 `robots` on belong to none.
struct Team : ::testing::Test {
  std::uint32_t robots = 40;
  std::vector<Task> tasks;
  std::vector<Task::Due> due;

  std::uint32_t common(std::uint32_t i) const { return 10 * robots + i; }
  Task& add(std::vector<Phase> phases) {
    Task t;
    t.items = t.robots = robots;
    for (std::uint32_t r = 0; r < robots; ++r) t.robot_of_item.push_back(RobotId{r});
    t.phases = std::move(phases);
    due.push_back({TaskId(tasks.size()), 0.001});
    return tasks.emplace_back(std::move(t));
  }
  void every(Task& t, std::uint32_t slot, bool exclusive) const {
    for (std::uint32_t r = 0; r < robots; ++r) t.accesses.push_back({10 * r + slot, exclusive});
  }
  std::vector<RobotId> robot_of_slot() const {
    std::vector<RobotId> of(10 * robots + 10, no_robot);
    for (std::uint32_t s = 0; s < 10 * robots; ++s) of[s] = RobotId{s / 10};
    return of;
  }
  std::vector<Stage> stages() const { return stages_of(due, tasks, robot_of_slot()); }
};
using Stages = Team;

TEST_F(Stages, TasksOnTheirOwnRobotsFormACallChainForEachBlock) {
  tasks.reserve(3);
  for (int i = 0; i < 3; ++i) every(add({{IndexSpace::items, Scope::own_robot}}), 0, true);
  const auto all = stages();
  ASSERT_EQ(all.size(), 1u);
  ASSERT_EQ(all[0].chains(), block_bounds(robots).size() - 1);
  for (std::uint32_t c = 0; c < all[0].chains(); ++c) {
    const auto chain = all[0].chain(c);
    ASSERT_EQ(chain.size(), 3u);
    for (TaskId t = 0; t < 3; ++t) {
      EXPECT_EQ(chain[t].task, t);
      EXPECT_EQ(chain[t].range.begin, chain[0].range.begin);
      EXPECT_EQ(chain[t].range.end, chain[0].range.end);
    }
  }
}

TEST_F(Stages, AReaderOfAllRobotsIsAStageBetweenWriters) {
  tasks.reserve(3);
  every(add({{IndexSpace::items, Scope::own_robot}}), 0, true);
  Task& reader = add({{IndexSpace::items, Scope::reads_all}});
  every(reader, 0, false);
  every(reader, 1, true);
  every(add({{IndexSpace::items, Scope::own_robot}}), 0, true);
  EXPECT_EQ(stages().size(), 3u);
}

TEST_F(Stages, AnUndividedPhaseIsAStageBetweenDividedOnes) {
  every(add({{IndexSpace::robots, Scope::own_robot},
             {IndexSpace::whole, Scope::reads_all},
             {IndexSpace::robots, Scope::own_robot}}),
        0, true);
  const auto all = stages();
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[1].chains(), 1u);
  EXPECT_EQ(all[1].calls[0].range.end, robots);
}

TEST_F(Stages, ATaskThatRunsAloneOverlapsWithNothing) {
  tasks.reserve(3);
  every(add({{IndexSpace::items, Scope::own_robot}}), 0, true);
  add({{IndexSpace::whole}}).runs_alone = true;
  every(add({{IndexSpace::items, Scope::own_robot}}), 1, true);
  const auto all = stages();
  ASSERT_EQ(all.size(), 3u);
  EXPECT_EQ(all[1].chains(), 1u);
  EXPECT_EQ(all[1].calls[0].task, 1u);
}

TEST_F(Stages, WithoutOverlapEachPhaseOfATaskIsAStage) {
  tasks.reserve(2);
  every(add({{IndexSpace::robots, Scope::own_robot}, {IndexSpace::robots, Scope::own_robot}}), 0, true);
  every(add({{IndexSpace::robots, Scope::own_robot}}), 1, true);
  EXPECT_EQ(stages().size(), 1u);
  const auto all = stages_of(due, tasks, robot_of_slot(), false);
  ASSERT_EQ(all.size(), 3u);
  for (std::size_t k = 0; k < 3; ++k) {
    EXPECT_EQ(all[k].chains(), block_bounds(robots).size() - 1);
    for (const Stage::Call& c : all[k].calls) EXPECT_EQ(c.task * 2 + c.phase, k);
  }
}

TEST_F(Stages, AStageIsDisabledWhenAllOfItsCallsAre) {
  tasks.reserve(2);
  std::uint8_t enabled = 0;
  const Phase maybe{.index_space = IndexSpace::robots, .enabled = &enabled};
  every(add({{IndexSpace::whole}, maybe, maybe}), 0, true);
  every(add({{IndexSpace::robots, Scope::own_robot}}), 0, true);
  const auto all = stages();
  ASSERT_EQ(all.size(), 3u);  // the last phase of the first task and the second task share call chains
  EXPECT_TRUE(all[0].is_enabled());
  EXPECT_FALSE(all[1].is_enabled());
  EXPECT_TRUE(all[2].is_enabled());
  EXPECT_FALSE(all[2].chain(0)[0].is_enabled());
  EXPECT_TRUE(all[2].chain(0)[1].is_enabled());
  enabled = 1;
  EXPECT_TRUE(all[1].is_enabled());
  EXPECT_TRUE(all[2].chain(0)[0].is_enabled());
}

TEST_F(Stages, TasksWithoutCommonPropertiesOverlap) {
  tasks.reserve(6);
  for (std::uint32_t i = 0; i < 6; ++i) {
    Task& t = add({{}});
    t.accesses = {{10 * i, true}, {common(0), false}};
  }
  const auto all = stages();
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].chains(), 6u);
}

TEST_F(Stages, FineGrainedElementsAreCallsOfTheirOwn) {
  every(add({{IndexSpace::items, Scope::reads_all, true}}), 0, true);
  const auto all = stages();
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].chains(), robots);
}

TEST_F(Stages, ItemsThatAreNotInTheOrderOfRobotsAreNotDivided) {
  Task& t = add({{IndexSpace::items, Scope::own_robot}});
  std::swap(t.robot_of_item[3], t.robot_of_item[30]);
  every(t, 0, true);
  const auto all = stages();
  ASSERT_EQ(all.size(), 1u);
  EXPECT_EQ(all[0].chains(), 1u);
}

/// Random tasks: calls keep their order if they share a slot and one of them writes to it.
TEST_F(Stages, EveryConflictKeepsTheOrderOfDueTasks) {
  std::mt19937 random(7);
  const auto below = [&](std::uint32_t n) { return std::uniform_int_distribution<std::uint32_t>(0, n - 1)(random); };
  for (int round = 0; round < 200; ++round) {
    tasks.clear();
    due.clear();
    tasks.reserve(12);
    for (int k = 0; k < 12; ++k) {
      std::vector<Phase> phases;
      for (std::uint32_t p = 0; p <= below(3); ++p)
        phases.push_back({IndexSpace(below(3)), Scope(below(2)), below(4) == 0});
      Task& t = add(phases);
      for (std::uint32_t slot = 0; slot < 4; ++slot)
        if (below(3) == 0) every(t, slot, below(2) == 0);
      if (below(3) == 0) t.accesses.push_back({common(below(3)), below(2) == 0});
    }
    const auto all = stages();
    const auto of_slot = robot_of_slot();
    struct Seen {
      std::size_t stage;
      std::uint32_t chain;
      std::uint32_t order, phase;
      bool exclusive;
    };
    std::map<std::uint32_t, std::vector<Seen>> seen;
    std::set<std::tuple<std::uint32_t, std::uint32_t, std::uint32_t>> served;
    for (std::size_t s = 0; s < all.size(); ++s)
      for (std::uint32_t c = 0; c < all[s].chains(); ++c)
        for (const Stage::Call& call : all[s].chain(c)) {
          const Phase phase = tasks[call.task].phases[call.phase];
          for (std::uint32_t i = call.range.begin; i < call.range.end; ++i)
            EXPECT_EQ(served.insert(std::tuple(call.order, call.phase, i)).second, true);
          for (const Task::Access& a : tasks[call.task].accesses) {
            const RobotId robot = of_slot[a.slot];
            const bool inside =
                robot == no_robot || (index_of(robot) >= call.range.begin && index_of(robot) < call.range.end);
            const bool has_access =
                phase.index_space == IndexSpace::whole || inside || (phase.scope == Scope::reads_all && !a.exclusive);
            if (!has_access) continue;
            for (const Seen& before : seen[a.slot]) {
              if (!before.exclusive && !a.exclusive) continue;
              if (before.order == call.order && before.phase == call.phase) continue;  // the phase guarantees it
              const bool earlier = before.order != call.order ? before.order < call.order : before.phase < call.phase;
              ASSERT_TRUE(earlier && (before.stage < s || before.chain == c))
                  << "round " << round << " slot " << a.slot;
            }
            seen[a.slot].push_back({s, c, call.order, call.phase, a.exclusive});
          }
        }
    std::size_t phases = 0;
    for (const Task& t : tasks) phases += t.phases.size();
    ASSERT_EQ(served.size(), phases * robots);
  }
}

}  // namespace
}  // namespace muro
