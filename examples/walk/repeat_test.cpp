// SPDX-License-Identifier: MIT
// Equal bits on any number of threads, from a snapshot and after a reset.
#include <gtest/gtest.h>

#include "examples/common/repeat_testing.hpp"
#include "walk_testing.hpp"

namespace muro::walk_test {
namespace {

using example_test::expect_same_bits_from_snapshot;
using example_test::hash_on;

TEST(Repeat, ThreadsDoNotMatter) { EXPECT_EQ(hash_on(1, scenario, {}, 4), hash_on(3, scenario, {}, 4)); }

TEST(Repeat, ASnapshotAndAResetGoOnAlike) {
  Walker walker;
  Simulation& s = walker.simulation();
  const std::uint64_t end = expect_same_bits_from_snapshot(s, 4, 1);
  s.reset();
  s.run_for(5);
  EXPECT_EQ(s.state_hash(), end);
}

}  // namespace
}  // namespace muro::walk_test
