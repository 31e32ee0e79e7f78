// SPDX-License-Identifier: MIT
// Equal bits on any number of threads, from a snapshot and after a reset.
#include <gtest/gtest.h>

#include "quadruped_testing.hpp"

namespace muro::quadruped_test {
namespace {

TEST(Repeat, ThreadsDoNotMatter) {
  const auto hash = [](unsigned threads) {
    Walk walk(scenario, {});
    walk.simulation().set_threads(threads);
    walk.run(1);
    return walk.simulation().state_hash();
  };
  EXPECT_EQ(hash(1), hash(3));
}

TEST(Repeat, ASnapshotAndAResetGoOnAlike) {
  Walk walk(scenario, {});
  Simulation& s = walk.simulation();
  walk.run(1.1);
  const Snapshot middle = s.snapshot();
  walk.run(0.5);
  const std::uint64_t end = s.state_hash();
  s.restore(middle);
  walk.run(0.5);
  EXPECT_EQ(s.state_hash(), end);
  s.reset();
  walk.run(1.6);
  EXPECT_EQ(s.state_hash(), end);
}

}  // namespace
}  // namespace muro::quadruped_test
