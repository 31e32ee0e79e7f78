// SPDX-License-Identifier: MIT
#include "core/schedule/balance.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

namespace muro {
namespace {

using Costs = std::vector<std::vector<std::uint64_t>>;  ///< ticks, by stage and chain

std::vector<std::uint32_t> chains_of(const Balance& balance, unsigned thread) {
  const std::uint32_t begin = thread == 0 ? 0 : balance.ends()[thread - 1];
  return {balance.order().begin() + begin, balance.order().begin() + balance.ends()[thread]};
}

/// Until the last thread is done, over all stages.
std::uint64_t length(const Balance& balance, const Costs& costs) {
  std::uint64_t sum = 0;
  for (const auto& stage : costs) {
    std::uint64_t longest = 0;
    for (unsigned t = 0; t < balance.ends().size(); ++t) {
      std::uint64_t load = 0;
      for (const std::uint32_t c : chains_of(balance, t)) load += stage[c];
      longest = std::max(longest, load);
    }
    sum += longest;
  }
  return sum;
}

/// The shortest length of one stage on two threads: every way to share the chains is tried.
std::uint64_t shortest(const std::vector<std::uint64_t>& stage) {
  const std::uint64_t all = std::accumulate(stage.begin(), stage.end(), std::uint64_t(0));
  std::uint64_t best = all;
  for (std::uint32_t first = 0; first < 1u << stage.size(); ++first) {
    std::uint64_t load = 0;
    for (std::size_t c = 0; c < stage.size(); ++c) load += first >> c & 1 ? stage[c] : 0;
    best = std::min(best, std::max(load, all - load));
  }
  return best;
}

struct Team {
  Balance balance;
  Costs costs;

  Team(unsigned threads, Costs c) : balance(std::uint32_t(c[0].size()), threads), costs(std::move(c)) {
    for (std::size_t s = 0; s < costs.size(); ++s) balance.add_stage();
  }
  void improve(int times = 1) {
    for (int i = 0; i < times; ++i) {
      run();
      balance.improve();
    }
  }
  void run() {
    for (std::uint32_t s = 0; s < costs.size(); ++s)
      for (std::uint32_t c = 0; c < costs[s].size(); ++c) balance.add_cost(s, c, costs[s][c]);
  }
};

TEST(Balance, BeginsWithNeighbouringChainsOnEachThreadAndTheLastOnTheFirst) {
  const Balance balance(7, 2);
  EXPECT_EQ(chains_of(balance, 0), (std::vector<std::uint32_t>{4, 5, 6}));
  EXPECT_EQ(chains_of(balance, 1), (std::vector<std::uint32_t>{0, 1, 2, 3}));
}

TEST(Balance, GivesTheFirstThreadAChainWhereThereAreFewerThanThreads) {
  for (const unsigned threads : {3u, 4u, 8u}) {
    const Balance balance(2, threads);
    EXPECT_EQ(chains_of(balance, 0), std::vector<std::uint32_t>{1});
    EXPECT_EQ(chains_of(balance, 1), std::vector<std::uint32_t>{0});
    EXPECT_EQ(balance.ends().back(), 2u);
  }
}

TEST(Balance, ComesCloseToTheBestOfAllWaysToShareTheChains) {
  for (const std::vector<std::uint64_t>& stage : Costs{{345, 400, 340, 240},
                                                       {90, 10, 10, 10, 10, 10, 10, 10},
                                                       {100, 200, 300, 400, 500, 600, 700, 800, 900, 1000},
                                                       {31, 41, 59, 26, 53, 58, 97, 93, 23, 84, 62, 64}}) {
    Team team(2, {stage});
    team.improve(30);
    EXPECT_LE(double(length(team.balance, team.costs)), 1.03 * double(shortest(stage)));
  }
}

TEST(Balance, OfTwoStagesLooksForTheShortestTogether) {
  // Each alone would be shared as {0, 3} and {1, 2}, or as {0, 1} and {2, 3}.
  Team team(2, {{500, 100, 100, 500}, {10, 30, 30, 10}});
  team.improve(10);
  EXPECT_EQ(length(team.balance, team.costs), 640u);
}

TEST(Balance, ServesEightThreads) {
  Costs costs(1);
  for (std::uint64_t c = 0; c < 32; ++c) costs[0].push_back(100 + 37 * c % 200);
  Team team(8, costs);
  team.improve(60);
  const auto all = std::accumulate(costs[0].begin(), costs[0].end(), std::uint64_t(0));
  EXPECT_LE(double(length(team.balance, costs)), 1.1 * double(all) / 8);
  std::vector<std::uint32_t> order(team.balance.order().begin(), team.balance.order().end());
  std::sort(order.begin(), order.end());
  for (std::uint32_t c = 0; c < 32; ++c) EXPECT_EQ(order[c], c);
}

TEST(Balance, LeavesChainsWhereTheyAreWhenLittleIsGained) {
  Team team(2, {{100, 101, 100, 102}});
  const std::vector<std::uint32_t> before(team.balance.order().begin(), team.balance.order().end());
  team.improve(20);
  EXPECT_TRUE(std::equal(before.begin(), before.end(), team.balance.order().begin()));
}

TEST(Balance, AThreadThatIsHeldUpOnceMovesNothing) {
  Team team(2, {{100, 100, 100, 100, 100, 100}});
  const std::vector<std::uint32_t> before(team.balance.order().begin(), team.balance.order().end());
  for (int i = 0; i < 64; ++i) team.run();
  team.balance.add_cost(0, 2, 1'000'000);
  team.balance.improve();
  EXPECT_TRUE(std::equal(before.begin(), before.end(), team.balance.order().begin()));
}

}  // namespace
}  // namespace muro
