// SPDX-License-Identifier: MIT
// Equal bits on any number of threads, from a snapshot and after a reset.
#include <gtest/gtest.h>

#include "examples/common/repeat_testing.hpp"
#include "quadruped_testing.hpp"

namespace muro::quadruped_test {
namespace {

using example_test::expect_same_bits_from_snapshot;
using example_test::hash_on;

TEST(Repeat, ThreadsDoNotMatter) { EXPECT_EQ(hash_on(1, scenario, {}, 1), hash_on(3, scenario, {}, 1)); }

TEST(Repeat, ASnapshotAndAResetGoOnAlike) {
  Walk walk(scenario, {});
  Simulation& s = walk.simulation();
  const std::uint64_t end = expect_same_bits_from_snapshot(s, 1.1, 0.5);
  s.reset();
  s.run_for(1.6);
  EXPECT_EQ(s.state_hash(), end);
}

}  // namespace
}  // namespace muro::quadruped_test
